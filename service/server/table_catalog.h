// The tables that a server answers from, by name.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "tables/column_query.h"
#include "tables/table_folder.h"
#include "tables/uncertainty_table.h"

namespace albtpu::server {

// Immutable. Every table in it has been read and checked as a whole.
class TableCatalog {
 public:
  // Reads all tables of `folder` (table_folder.h says which files are tables). `default_table`, unless empty,
  // names the table that is meant when none is named. Fails when there is no table, when one table cannot be
  // read, or when there is none of the name `default_table`.
  static absl::StatusOr<TableCatalog> Load(const std::filesystem::path& folder,
                                           std::string_view default_table);

  struct Entry {
    std::string name;  // NAME or NAME/VERSION.
    UncertaintyTable table;
    ColumnInterpolator interpolator;  // Of the table.
  };
  // By name, then from the newest version.
  const std::vector<Entry>& entries() const { return entries_; }

  // As FindTable does; the result lives as long as the catalog.
  absl::StatusOr<const Entry*> Find(std::string_view request) const;

 private:
  TableCatalog(std::vector<TableFile> files, std::vector<Entry> entries, std::string_view default_table)
      : files_(std::move(files)), entries_(std::move(entries)), default_table_(default_table) {}

  std::vector<TableFile> files_;
  std::vector<Entry> entries_;  // One for each file.
  std::string default_table_;
};

}  // namespace albtpu::server
