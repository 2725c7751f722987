// The folder in which finished units lie, one file each, beside the text of their campaign. Many processes
// may write into one folder, on many machines that share it: a unit gets its name when it is whole.
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

namespace albtpu {

class WorkFolder {
 public:
  // Makes the folder, and leaves the campaign in it, where that is not done. FailedPrecondition when another
  // campaign is there; otherwise the reason of the system.
  static absl::StatusOr<WorkFolder> Open(const std::filesystem::path& folder, const Campaign& campaign);

  // One that is there. NotFound when it is not, or has no campaign.
  static absl::StatusOr<WorkFolder> OpenExisting(const std::filesystem::path& folder);

  // The campaign that lies in the folder.
  absl::StatusOr<Campaign> ReadCampaign() const;

  // Those of `units` that are there: their files are, which nobody has read.
  absl::StatusOr<std::vector<UnitId>> Finished(const std::vector<UnitId>& units) const;

  // Reads units and gives their bytes, as they are, to `sink`. Its first failure ends the reading and is
  // returned with the name of the file before it.
  using Sink = std::function<absl::Status(UnitId unit, const std::string& bytes)>;
  absl::Status Read(const std::vector<UnitId>& units, const Sink& sink) const;

  // A unit that is there is left as it is; AlreadyExists when its bytes are others.
  absl::Status Store(UnitId unit, const std::string& bytes) const;

  // What killed writers left. Those of living ones would go too: for the only user of the folder.
  absl::Status RemoveTemporaries() const;

  std::filesystem::path PathOf(UnitId unit) const;

 private:
  explicit WorkFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path folder_;
};

}  // namespace albtpu
