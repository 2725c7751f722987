// The tables that answer now, and those that take their place when the folder has changed.
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

// May be used from several threads.
class LiveTables {
 public:
  // What became of each table, or why nothing was changed.
  using Outcome = absl::StatusOr<std::vector<TableCatalog::Change>>;
  using Listener = std::function<void(const Outcome&)>;

  // `on_reload` is told of every reload.
  explicit LiveTables(
      TableCatalog catalog, Listener on_reload = [](const Outcome&) {});

  // The reload that is under way is finished, those that wait are not begun.
  ~LiveTables();

  // A call takes this once, when it begins, and finishes on it: tables live as long as anybody answers from
  // them.
  std::shared_ptr<const TableCatalog> current() const;

  // Reads the folder again, on a thread of its own, and on success has its tables answer from then on; on any
  // failure the present ones do. Then `done` is told. Whoever asks while a reload has yet to begin shares it.
  void Reload(Listener done);

 private:
  void Run();
  Outcome ReloadNow();

  const Listener on_reload_;
  mutable std::mutex mutex_;  // Guards what is before the blank line.
  std::shared_ptr<const TableCatalog> current_;
  std::vector<Listener> waiting_;
  bool stopping_ = false;
  std::condition_variable changed_;

  std::thread thread_;  // The last: it uses all others.
};

}  // namespace albtpu::server
