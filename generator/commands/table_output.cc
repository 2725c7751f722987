#include "generator/commands/table_output.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iostream>

#include "absl/strings/str_cat.h"
#include "tables/file/table_io.h"

namespace albtpu {

absl::Status CheckOutput(const std::filesystem::path& output, bool overwrite) {
  const std::string name = output.string();
  std::error_code error;
  const std::filesystem::file_status there = std::filesystem::status(output, error);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there)) {
    return absl::InvalidArgumentError(absl::StrCat(name, ": is not a regular file: name one to write"));
  }
  if (std::filesystem::exists(there) && !overwrite) {
    return absl::AlreadyExistsError(absl::StrCat(name, ": is there already; --overwrite replaces it"));
  }
  const std::filesystem::path folder =
      output.has_parent_path() ? output.parent_path() : std::filesystem::path(".");
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

absl::Status Publish(const UncertaintyTable& table, const std::filesystem::path& output, bool overwrite) {
  const absl::Status written = WriteTable(table, output, overwrite ? Existing::kReplace : Existing::kKeep);
  if (!written.ok()) return written;
  std::cout << "id " << table.provenance().id << "\nversion " << table.provenance().version << "\ndigest "
            << table.digest() << '\n';
  return absl::OkStatus();
}

}  // namespace albtpu
