#include <algorithm>

#include "absl/strings/str_cat.h"
#include "generator/campaign/table_maker.h"
#include "generator/campaign/work_folder.h"
#include "programs/generate/commands.h"
#include "programs/generate/progress.h"
#include "programs/generate/table_output.h"

namespace albtpu::programs {

absl::Status RunMerge(const MergeOptions& options) {
  const absl::StatusOr<WorkFolder> work = WorkFolder::OpenExisting(options.work);
  if (!work.ok()) return work.status();
  const absl::StatusOr<Campaign> campaign = work->ReadCampaign();
  if (!campaign.ok()) return campaign.status();
  if (const absl::Status status = CheckOutput(options.output, options.overwrite); !status.ok()) return status;

  const std::vector<UnitId> units = UnitsOf(*campaign);
  const absl::StatusOr<std::vector<UnitId>> finished = work->Finished(units);
  if (!finished.ok()) return finished.status();
  if (finished->size() < units.size()) {
    const auto missing = std::mismatch(units.begin(), units.end(), finished->begin(), finished->end()).first;
    return absl::FailedPreconditionError(absl::StrCat(
        options.work.string(), ": has ", finished->size(), " of ", units.size(), " units, ", Name(*missing),
        " is the first that is missing; compute it with `table --work --resume`, or with its shard"));
  }
  TableBuilder builder(*campaign);
  {
    Progress progress(absl::StrCat("albtpu-generate: reading units of '", campaign->id, "'"), units.size());
    std::size_t done = 0;
    const absl::Status read = work->Read(units, [&](UnitId unit, const std::string& bytes) {
      progress.Reach(++done);
      return builder.Add(unit, bytes);
    });
    if (!read.ok()) return read;
  }
  const absl::StatusOr<Table> table = builder.Build();
  if (!table.ok()) return table.status();
  return Publish(*table, options.output, options.overwrite);
}

}  // namespace albtpu::programs
