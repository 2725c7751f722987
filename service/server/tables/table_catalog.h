// The tables that a server answers from, by name.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "service/server/ground/file_stamp.h"
#include "tables/file/table_folder.h"
#include "tables/query/column_query.h"
#include "tables/uncertainty_table.h"

namespace albtpu::server {

// Immutable. Every table in it has been read and checked as a whole.
class TableCatalog {
 public:
  struct Entry {
    std::string name;  // NAME or NAME/VERSION.
    UncertaintyTable table;
    ColumnInterpolator interpolator;  // Of the table.
    FileStamp stamp;                  // Of the file, before it was read.
  };

  // Reads all tables of `folder` (table_folder.h says which files are tables). `default_table`, unless empty,
  // names the table that is meant when none is named. Fails when there is no table, when a table cannot be
  // read (the message says why of each), when the folder gives one name to two tables, or when there is none
  // of the name `default_table`.
  static absl::StatusOr<TableCatalog> Load(const std::filesystem::path& folder,
                                           std::string_view default_table);

  // What became of a table when its folder was read again.
  struct Change {
    enum class Kind {
      kLoaded,   // New, or another than before.
      kKept,     // The file has not changed, and was not read again.
      kRemoved,  // The file is gone, and so is the table.
    };
    std::string name;
    Kind kind;
  };
  struct Reread;

  // Reads the folder again, as a whole or not at all: fails as Load does. Tables whose files have not changed
  // are shared with the new catalog.
  absl::StatusOr<Reread> ReadAgain() const;

  // By name, then from the newest version.
  const std::vector<std::shared_ptr<const Entry>>& entries() const { return entries_; }

  // As FindTable does; the result lives as long as the catalog.
  absl::StatusOr<const Entry*> Find(std::string_view request) const;

  const std::filesystem::path& folder() const { return folder_; }

 private:
  TableCatalog(const std::filesystem::path& folder, std::string_view default_table)
      : folder_(folder), default_table_(default_table) {}

  std::shared_ptr<const Entry> EntryOf(std::string_view name) const;

  std::filesystem::path folder_;
  std::string default_table_;
  std::vector<TableFile> files_;
  std::vector<std::shared_ptr<const Entry>> entries_;  // One for each file.
};

struct TableCatalog::Reread {
  TableCatalog catalog;
  std::vector<Change> changes;  // By name, then from the newest version; those that were removed last.
};

}  // namespace albtpu::server
