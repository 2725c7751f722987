// The tables of a server, and their replacement when their files have changed.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "service/server/ground/file_value.h"
#include "service/server/tables/wire_enums.h"
#include "tables/file/table_folder.h"
#include "tables/water/water_column_table.h"

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
  static absl::StatusOr<TableCatalog> Load(const std::filesystem::path& folder, std::string_view default_table);

  // The table of the water column. No request names it; it computes the waters that requests carry.
  struct Water {
    std::filesystem::path path;
    WaterColumnTable table;
    FileIdentity identity;
  };

  // Reads the table of the water column, which a catalog has only after this.
  absl::Status AddWater(const std::filesystem::path& file);

  // The change of a table when its file was read again.
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

  // Reads the files again. If any table is invalid, the whole reload fails, as Load does. Tables whose files have not
  // changed are shared with the new catalog.
  absl::StatusOr<Reloaded> Reload() const;

  // Sorted by name, the newest version first.
  const std::vector<std::shared_ptr<const Entry>>& entries() const { return entries_; }

  // As FindTable. The result lives as long as the catalog.
  absl::StatusOr<const Entry*> Find(std::string_view request) const;

  const std::filesystem::path& folder() const { return folder_; }

  // Null: without.
  const std::shared_ptr<const Water>& water() const { return water_; }

 private:
  TableCatalog(const std::filesystem::path& folder, std::string_view default_table)
      : folder_(folder), default_table_(default_table) {}

  std::shared_ptr<const Entry> EntryOf(std::string_view name) const;

  std::filesystem::path folder_;
  std::string default_table_;
  std::vector<TableFile> files_;
  std::vector<std::shared_ptr<const Entry>> entries_;  // One for each file.
  std::shared_ptr<const Water> water_;
};

struct TableCatalog::Reloaded {
  TableCatalog catalog;
  std::vector<Change> changes;  // Sorted like entries(), without the water; removed tables come last.
};

// The tables currently in use, and their replacement when their files have changed. Thread-safe.
class LiveTables {
 public:
  // The change of each table, or why nothing changed.
  using ReloadResult = absl::StatusOr<std::vector<TableCatalog::Change>>;
  using Listener = std::function<void(const ReloadResult&)>;

  // `on_reload` is called after every reload.
  explicit LiveTables(
      TableCatalog catalog, Listener on_reload = [](const ReloadResult&) {});

  // Finishes a reload in progress; reloads that are waiting do not start.
  ~LiveTables();

  // Each call takes this once, at its beginning, and uses it to its end: tables live as long as a call uses them.
  std::shared_ptr<const TableCatalog> current() const;

  // Reads the files again, on a separate thread. On success its tables are used from then on; on any failure the
  // present tables stay in use. Then calls `done`. Requests that arrive before a reload has started share it.
  void Reload(Listener done);

 private:
  void Run();
  ReloadResult ReloadNow();

  const Listener on_reload_;
  mutable std::mutex mutex_;  // Guards the members up to the blank line.
  std::shared_ptr<const TableCatalog> current_;
  std::vector<Listener> waiting_;
  bool stopping_ = false;
  std::condition_variable changed_;

  std::thread thread_;  // Last, because it uses all other members.
};

}  // namespace albtpu::server
