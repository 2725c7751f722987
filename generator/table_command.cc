#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iostream>

#include "absl/strings/str_cat.h"
#include "generator/commands.h"
#include "generator/progress.h"
#include "generator/table_maker.h"
#include "tables/table_io.h"

namespace albtpu {
namespace {

// What would keep the table from being written is looked for before the work.
absl::Status CheckOutput(const TableOptions& options) {
  const std::string name = options.output.string();
  std::error_code error;
  const std::filesystem::file_status there = std::filesystem::status(options.output, error);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there)) {
    return absl::InvalidArgumentError(absl::StrCat(name, ": is not a regular file: name one to write"));
  }
  if (std::filesystem::exists(there) && !options.overwrite) {
    return absl::AlreadyExistsError(absl::StrCat(name, ": is there already; --overwrite replaces it"));
  }
  const std::filesystem::path folder =
      options.output.has_parent_path() ? options.output.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder, error)) {
    return absl::NotFoundError(absl::StrCat(name, ": there is no folder ", folder.string()));
  }
  std::string probe = (folder / ".albtpu-probe-XXXXXX").string();
  const int file = mkstemp(probe.data());
  if (file < 0) {
    return absl::PermissionDeniedError(
        absl::StrCat(name, ": the folder ", folder.string(), " is not writable: ", std::strerror(errno)));
  }
  close(file);
  unlink(probe.c_str());
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
