// A folder of tables: NAME.h5, or NAME/VERSION.h5 if several versions of a table are kept. Finds the table that a
// name means, and the default table.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace albtpu {

// A table file by its place in the folder, not by its content.
struct TableFile {
  std::string name;     // "survey"
  std::string version;  // "2024.2"; empty if the folder does not keep versions of this table.
  std::filesystem::path path;
  // UncertaintyTable::is_published. FindTables does not read files: the caller sets it.
  bool published = false;

  std::string FullName() const;  // "survey/2024.2", or "survey" without a version.
};

// All tables in a folder, by name, the newest version first. NAME and VERSION are [A-Za-z0-9][A-Za-z0-9._-]*; all
// other files and folders are ignored. Every file with the name of a table is listed, whatever its content.
// NotFound: there is no such folder. InvalidArgument: there are both NAME.h5 and NAME/VERSION.h5, so that a name
// would mean two tables.
absl::StatusOr<std::vector<TableFile>> FindTables(const std::filesystem::path& folder);

// The digests of the tables in a folder for people and scripts, a line each: "table survey/2024.2 9b1c...". A table
// that cannot be read has its message there, and so has a folder without tables.
std::string DigestsText(const std::filesystem::path& folder);

// The natural order of versions: runs of digits compare as numbers, everything else as bytes, and a version is
// older than one that it is the beginning of. 1 < 1.9 < 1.10 < 2, 2024-05-01 < 2024-12-01, 1.0 < 1.0-rc1.
bool IsOlder(std::string_view version, std::string_view other);

// The index of the table that `request` means: a FullName(), or a name alone for its newest version. An empty
// request means the default: `default_table` unless that is empty, else `survey`, else the only name there is, else
// the only name of a table that is not published. Published numbers are for comparison, and answer only if asked
// for by name. `tables` are in the order of FindTables. NotFound: there is no such table. FailedPrecondition: there
// is no default. Both messages list the names.
absl::StatusOr<std::size_t> FindTable(std::span<const TableFile> tables, std::string_view request,
                                      std::string_view default_table = {});

}  // namespace albtpu
