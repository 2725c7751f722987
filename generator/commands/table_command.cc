#include <algorithm>
#include <exception>
#include <iostream>
#include <memory>
#include <optional>

#include "absl/strings/str_cat.h"
#include "generator/campaign/table_maker.h"
#include "generator/campaign/unit_work.h"
#include "generator/campaign/work_folder.h"
#include "generator/commands/commands.h"
#include "generator/commands/progress.h"
#include "generator/commands/table_output.h"
#include "generator/ranks/ranks.h"

namespace albtpu {
namespace {

// Those of all units that this command is for.
std::vector<UnitId> Share(const std::vector<UnitId>& units, const std::optional<Shard>& shard) {
  if (!shard) return units;
  std::vector<UnitId> share;
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (i % shard->count == static_cast<std::size_t>(shard->index)) share.push_back(units[i]);
  }
  return share;
}

// Takes what the folder has of `units`, which only --resume asks for, and leaves in `units` what is to be
// done.
absl::Status TakeFinished(const WorkFolder& work, bool resume, std::vector<UnitId>& units,
                          TableBuilder& builder) {
  const absl::StatusOr<std::vector<UnitId>> finished = work.Finished(units);
  if (!finished.ok()) return finished.status();
  if (!finished->empty() && !resume) {
    return absl::AlreadyExistsError(absl::StrCat(
        work.PathOf(finished->front()).parent_path().string(), ": has ", finished->size(), " of these ",
        units.size(), " units already: --resume takes them, another folder begins anew"));
  }
  std::erase_if(units,
                [&](UnitId unit) { return std::binary_search(finished->begin(), finished->end(), unit); });
  return work.Read(*finished,
                   [&](UnitId unit, const std::string& bytes) { return builder.Add(unit, bytes); });
}

std::string Label(const Campaign& campaign, const std::optional<Shard>& shard, std::size_t taken) {
  std::string label = absl::StrCat("albtpu-generate: units of '", campaign.id, "'");
  if (shard) absl::StrAppend(&label, ", shard ", shard->index, "/", shard->count);
  if (taken > 0) absl::StrAppend(&label, ", ", taken, " more taken as they were");
  return label;
}

// What rank 0 does, or the only one.
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
    if (const absl::Status status = TakeFinished(*work, options.resume, units, builder); !status.ok()) {
      return status;
    }
    // Other shards may be writing.
    if (!options.shard) {
      if (const absl::Status status = work->RemoveTemporaries(); !status.ok()) return status;
    }
  }

  absl::Status worked_off;
  {
    Progress progress(Label(*campaign, options.shard, share.size() - units.size()), units.size());
    std::size_t done = 0;
    worked_off = ComputeUnits(
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
  if (!worked_off.ok()) return worked_off;
  if (options.shard) {
    std::cout << "units " << share.size() << '\n';
    return absl::OkStatus();
  }
  const absl::StatusOr<UncertaintyTable> table = builder.Build();
  if (!table.ok()) return table.status();
  if (const absl::Status status = Publish(*table, options.output, options.overwrite); !status.ok())
    return status;
  Dismiss(ranks);
  return absl::OkStatus();
}

}  // namespace

absl::Status RunTable(const TableOptions& options) {
  if (options.shard)
    return Lead(options, *OneRank());  // however it was started: it says itself what it is for
  absl::StatusOr<std::unique_ptr<Ranks>> joined = Ranks::Join();
  if (!joined.ok()) return joined.status();
  Ranks& ranks = **joined;
  if (ranks.size() == 1) return Lead(options, ranks);

  absl::Status status;
  try {
    status = ranks.rank() == 0 ? Lead(options, ranks) : FollowRankZero(ranks);
  } catch (const std::exception& error) {  // no memory, no threads
    status = absl::InternalError(error.what());
  }
  if (!status.ok()) {
    std::cerr << "albtpu-generate: rank " << ranks.rank() << ": " << std::string(status.message())
              << std::endl;
    ranks.EndAll();
  }
  return status;
}

}  // namespace albtpu
