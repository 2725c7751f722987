// The tables currently in use, and their replacement when the folder has changed.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "absl/status/statusor.h"
#include "service/server/tables/table_catalog.h"

namespace albtpu::server {

// Thread-safe.
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

  // Reads the folder again, on a separate thread. On success its tables are used from then on; on any failure the
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
