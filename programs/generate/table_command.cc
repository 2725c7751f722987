#include <algorithm>
#include <exception>
#include <iostream>
#include <memory>
#include <optional>

#include "absl/strings/str_cat.h"
#include "generator/campaign/table_maker.h"
#include "generator/campaign/unit_work.h"
#include "generator/campaign/work_folder.h"
#include "generator/ranks/ranks.h"
#include "programs/generate/commands.h"
#include "programs/generate/progress.h"
#include "programs/generate/table_output.h"

namespace albtpu::programs {
namespace {

// The units that this shard computes; all without a shard.
std::vector<UnitId> Share(const std::vector<UnitId>& units, const std::optional<Shard>& shard) {
  if (!shard) return units;
  std::vector<UnitId> share;
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (i % shard->count == static_cast<std::size_t>(shard->index)) share.push_back(units[i]);
  }
  return share;
}

// Adds the units that the folder has to `builder`, which needs --resume, and removes them from `units`.
absl::Status AddFinished(const WorkFolder& work, bool resume, std::vector<UnitId>& units,
                         TableBuilder& builder) {
  const absl::StatusOr<std::vector<UnitId>> finished = work.Finished(units);
  if (!finished.ok()) return finished.status();
  if (!finished->empty() && !resume) {
    return absl::AlreadyExistsError(absl::StrCat(
        work.PathOf(finished->front()).parent_path().string(), ": has ", finished->size(), " of these ",
        units.size(), " units already; give --resume to use them, or another folder to start anew"));
  }
  std::erase_if(units,
                [&](UnitId unit) { return std::binary_search(finished->begin(), finished->end(), unit); });
  return work.Read(*finished,
                   [&](UnitId unit, const std::string& bytes) { return builder.Add(unit, bytes); });
}

std::string Label(const Campaign& campaign, const std::optional<Shard>& shard, std::size_t taken) {
  std::string label = absl::StrCat("albtpu-generate: units of '", campaign.id, "'");
  if (shard) absl::StrAppend(&label, ", shard ", shard->index, "/", shard->count);
  if (taken > 0) absl::StrAppend(&label, ", ", taken, " more were finished before");
  return label;
}

// The work of rank 0, which may be the only one.
absl::Status Lead(const TableOptions& options, Ranks& ranks) {
  const absl::StatusOr<Campaign> campaign = ReadCampaign(options.campaign);
  if (!campaign.ok()) return campaign.status();
  if (!options.shard) {
    if (const absl::Status status = CheckOutput(options.output, options.overwrite); !status.ok())
      return status;
  }
  TableBuilder builder(*campaign);
  const std::vector<UnitId> share = Share(UnitsOf(*campaign), options.shard);
  std::vector<UnitId> units = share;
  std::optional<WorkFolder> work;
  if (!options.work.empty()) {
    absl::StatusOr<WorkFolder> opened = WorkFolder::Open(options.work, *campaign);
    if (!opened.ok()) return opened.status();
    work = *std::move(opened);
    if (const absl::Status status = AddFinished(*work, options.resume, units, builder); !status.ok()) {
      return status;
    }
    // With shards, other processes may be writing temporary files.
    if (!options.shard) {
      if (const absl::Status status = work->RemoveTemporaries(); !status.ok()) return status;
    }
  }

  absl::Status computed;
  {
    Progress progress(Label(*campaign, options.shard, share.size() - units.size()), units.size());
    std::size_t done = 0;
    computed = ComputeUnits(
        *campaign, units, ranks, [&](UnitId unit, const std::string& bytes, const std::string& from) {
          const absl::Status added = builder.Add(unit, bytes);
          if (!added.ok()) {
            return absl::Status(added.code(), absl::StrCat(Name(unit), ", computed by ", from, ": ",
                                                           std::string(added.message())));
          }
          const absl::Status stored = work ? work->Store(unit, bytes) : absl::OkStatus();
          progress.Reach(++done);
          return stored;
        });
  }
  if (!computed.ok()) return computed;
  if (options.shard) {
    std::cout << "units " << share.size() << '\n';
    return absl::OkStatus();
  }
  const absl::StatusOr<Table> table = builder.Build();
  if (!table.ok()) return table.status();
  if (const absl::Status status = Publish(*table, options.output, options.overwrite); !status.ok())
    return status;
  Dismiss(ranks);
  return absl::OkStatus();
}

}  // namespace

absl::Status RunTable(const TableOptions& options) {
  // A shard is a process of its own, even if it was started by an MPI launcher.
  if (options.shard) return Lead(options, *OneRank());
  absl::StatusOr<std::unique_ptr<Ranks>> joined = Ranks::Join();
  if (!joined.ok()) return joined.status();
  Ranks& ranks = **joined;
  if (ranks.size() == 1) return Lead(options, ranks);

  absl::Status status;
  try {
    status = ranks.rank() == 0 ? Lead(options, ranks) : FollowRankZero(ranks);
  } catch (const std::exception& error) {  // out of memory or threads
    status = absl::InternalError(error.what());
  }
  if (!status.ok()) {
    std::cerr << "albtpu-generate: rank " << ranks.rank() << ": " << std::string(status.message())
              << std::endl;
    ranks.EndAll();
  }
  return status;
}

}  // namespace albtpu::programs
