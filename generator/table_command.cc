#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "absl/strings/str_cat.h"
#include "generator/commands.h"
#include "generator/progress.h"
#include "generator/table_maker.h"
#include "tables/table_io.h"

namespace albtpu {
namespace {

// What would make the table useless after the work is looked at before it.
absl::Status CheckOutput(const TableOptions& options) {
  std::error_code error;
  if (std::filesystem::exists(options.output, error) && !options.overwrite) {
    return absl::AlreadyExistsError(
        absl::StrCat(options.output.string(), ": is there already; --overwrite replaces it"));
  }
  std::filesystem::path folder = options.output.parent_path();
  if (folder.empty()) folder = ".";
  if (!std::filesystem::is_directory(folder, error)) {
    return absl::NotFoundError(
        absl::StrCat(options.output.string(), ": there is no folder ", folder.string()));
  }
  if (access(folder.c_str(), W_OK) != 0) {
    return absl::PermissionDeniedError(
        absl::StrCat(options.output.string(), ": the folder ", folder.string(), " is not writable"));
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status RunTable(const TableOptions& options) {
  const absl::StatusOr<Campaign> campaign = ReadCampaign(options.campaign);
  if (!campaign.ok()) return campaign.status();
  if (const absl::Status status = CheckOutput(options); !status.ok()) return status;

  absl::StatusOr<UncertaintyTable> table;
  {
    Progress progress(absl::StrCat("albtpu-generate: seas and footprints of '", campaign->id, "'"),
                      EncounterCount(*campaign));
    table = MakeTable(*campaign, [&](std::size_t done) { progress.Reach(done); });
  }
  if (!table.ok()) return table.status();
  if (const absl::Status status =
          WriteTable(*table, options.output, options.overwrite ? Existing::kReplace : Existing::kKeep);
      !status.ok()) {
    return status;
  }
  std::cout << "id " << table->provenance().id << "\nversion " << table->provenance().version << "\ndigest "
            << table->digest() << '\n';
  return absl::OkStatus();
}

}  // namespace albtpu
