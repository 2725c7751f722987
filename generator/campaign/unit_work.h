// Computes units on the threads of this process and of the other ranks, and keeps finished units in a folder.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "generator/campaign/campaign.h"
#include "generator/campaign/unit.h"
#include "generator/ranks/ranks.h"

namespace albtpu {

// Receives a sealed unit. `from` names the rank that computed it, such as "rank 0", for messages.
using UnitSink = std::function<absl::Status(UnitId unit, const std::string& bytes, const std::string& from)>;

// Computes `units` on rank 0, one on each thread; idle threads help with the surfaces of other threads' sea cases. The
// other ranks, which must be in FollowRankZero, get units one by one as they ask for them. `sink` is called by one
// thread at a time, once for each unit, in no particular order. Its first failure ends the work and is returned.
absl::Status ComputeUnits(const Campaign& campaign, const std::vector<UnitId>& units, Ranks& ranks,
                          const UnitSink& sink);

// On rank 0, lets the other ranks return from FollowRankZero. Call it when the table is written.
void Dismiss(Ranks& ranks);

// On all ranks but 0, computes the units that rank 0 hands out, until rank 0 calls Dismiss. Fails when this rank cannot
// read the campaign.
absl::Status FollowRankZero(Ranks& ranks);

// The folder of finished units, one file each, with the text of their campaign. Many processes on many machines may
// write into one shared folder, because a unit gets its name only when it is complete.

class WorkFolder {
 public:
  // Creates the folder and writes the campaign into it, unless that is done. FailedPrecondition when the folder holds
  // another campaign; otherwise an error of the system.
  static absl::StatusOr<WorkFolder> Open(const std::filesystem::path& folder, const Campaign& campaign);

  // Opens a folder that exists. NotFound when it does not exist or holds no campaign.
  static absl::StatusOr<WorkFolder> OpenExisting(const std::filesystem::path& folder);

  // Reads the campaign of the folder.
  absl::StatusOr<Campaign> ReadCampaign() const;

  // Those of `units` whose files exist. The files are not read.
  absl::StatusOr<std::vector<UnitId>> Finished(const std::vector<UnitId>& units) const;

  // Reads units and passes their bytes to `sink`. Its first failure ends the reading and is returned, preceded by the
  // name of the file.
  using Sink = std::function<absl::Status(UnitId unit, const std::string& bytes)>;
  absl::Status Read(const std::vector<UnitId>& units, const Sink& sink) const;

  // Writes a unit. A unit that exists is not changed; AlreadyExists when its bytes differ.
  absl::Status Store(UnitId unit, const std::string& bytes) const;

  // Removes the temporary files of killed writers. It would remove those of running writers too: call it only when this
  // process alone uses the folder.
  absl::Status RemoveTemporaries() const;

  std::filesystem::path PathOf(UnitId unit) const;

 private:
  explicit WorkFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path folder_;
};

}  // namespace albtpu
