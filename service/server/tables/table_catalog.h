// The tables of a server, by name.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "service/server/ground/file_identity.h"
#include "service/server/tables/served_table.h"
#include "tables/file/table_folder.h"

namespace albtpu::server {

// Immutable. Every table in it has been read and checked completely.
class TableCatalog {
 public:
  struct Entry : ServedTable {
    FileIdentity identity;  // Of the file, before it was read.
  };

  // Reads all tables of `folder` (table_folder.h says which files are tables). `default_table`, unless empty, is the
  // table for requests that name none. Fails if there is no table, if a table cannot be read (the message gives the
  // reason for each), if two tables have the same name, or if `default_table` does not exist.
  static absl::StatusOr<TableCatalog> Load(const std::filesystem::path& folder,
                                           std::string_view default_table);

  // The change of a table when its folder was read again.
  struct Change {
    enum class Kind {
      kLoaded,   // New, or its file has changed.
      kKept,     // The file has not changed and was not read again.
      kRemoved,  // The file no longer exists.
    };
    std::string name;
    Kind kind;
  };
  struct Reloaded;

  // Reads the folder again. If any table is invalid, the whole reload fails, as Load does. Tables whose files have not
  // changed are shared with the new catalog.
  absl::StatusOr<Reloaded> Reload() const;

  // Sorted by name, the newest version first.
  const std::vector<std::shared_ptr<const Entry>>& entries() const { return entries_; }

  // As FindTable. The result lives as long as the catalog.
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

struct TableCatalog::Reloaded {
  TableCatalog catalog;
  std::vector<Change> changes;  // Sorted like entries(); removed tables come last.
};

}  // namespace albtpu::server
