#include "service/server/table_catalog.h"

#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "tables/table_io.h"

namespace albtpu::server {

absl::StatusOr<TableCatalog> TableCatalog::Load(const std::filesystem::path& folder,
                                                std::string_view default_table) {
  absl::StatusOr<std::vector<TableFile>> files = FindTables(folder);
  if (!files.ok()) return files.status();
  if (files->empty()) {
    return absl::NotFoundError(
        absl::StrCat("there is no table in '", folder.string(), "': tables are NAME.h5 and NAME/VERSION.h5"));
  }
  if (!default_table.empty()) {
    const absl::StatusOr<std::size_t> found = FindTable(*files, default_table);
    if (!found.ok()) {
      return absl::Status(found.status().code(), absl::StrCat("default table: ", found.status().message()));
    }
  }
  std::vector<Entry> entries;
  for (TableFile& file : *files) {
    absl::StatusOr<UncertaintyTable> table = ReadTable(file.path);
    if (!table.ok()) return table.status();
    file.published = table->is_published();
    ColumnInterpolator interpolator(*table);
    entries.push_back({file.FullName(), *std::move(table), std::move(interpolator)});
  }
  return TableCatalog(*std::move(files), std::move(entries), default_table);
}

absl::StatusOr<const TableCatalog::Entry*> TableCatalog::Find(std::string_view request) const {
  const absl::StatusOr<std::size_t> found = FindTable(files_, request, default_table_);
  if (!found.ok()) return found.status();
  return &entries_[*found];
}

}  // namespace albtpu::server
