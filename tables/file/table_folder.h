// A folder of tables: NAME.h5, or NAME/VERSION.h5 where several makings of one table are kept; which of them
// a name means, and which is meant when none is named.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace albtpu {

// A table file by what it is called: its place in the folder, not its content.
struct TableFile {
  std::string name;     // "survey"
  std::string version;  // "2024.2"; empty: the folder keeps no versions of this table.
  std::filesystem::path path;
  // UncertaintyTable::is_published, for who has read the file to say. FindTables reads none.
  bool published = false;

  std::string FullName() const;  // "survey/2024.2", or "survey" without a version.
};

// By name, then from the newest version. NAME and VERSION are [A-Za-z0-9][A-Za-z0-9._-]*; all other files and
// folders are ignored. What has the name of a table is listed, whatever it holds. NotFound: no such folder.
// InvalidArgument: NAME.h5 beside NAME/VERSION.h5, where a name would mean two tables.
absl::StatusOr<std::vector<TableFile>> FindTables(const std::filesystem::path& folder);

// The natural order of versions: runs of digits compare as numbers, the rest as bytes, and what merely goes
// on is newer. 1 < 1.9 < 1.10 < 2, 2024-05-01 < 2024-12-01, 1.0 < 1.0-rc1.
bool IsOlder(std::string_view version, std::string_view other);

// The index of the table that `request` means: FullName(), or a name alone for its newest version. An empty
// request means the default: `default_table` unless empty, else `survey`, else the only name there is, else the
// only name of a table that is not published: numbers from the literature are for comparison, and answer when
// they are asked for. `tables` are in the order of FindTables. NotFound: there is no such table.
// FailedPrecondition: there is no default. Both messages list the names.
absl::StatusOr<std::size_t> FindTable(std::span<const TableFile> tables, std::string_view request,
                                      std::string_view default_table = {});

}  // namespace albtpu
