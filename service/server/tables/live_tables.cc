#include "service/server/tables/live_tables.h"

#include <exception>
#include <utility>

#include "absl/status/status.h"

namespace albtpu::server {

LiveTables::LiveTables(TableCatalog catalog, Listener on_reload)
    : on_reload_(std::move(on_reload)),
      current_(std::make_shared<const TableCatalog>(std::move(catalog))),
      thread_([this] { Run(); }) {}

LiveTables::~LiveTables() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

std::shared_ptr<const TableCatalog> LiveTables::current() const {
  const std::lock_guard lock(mutex_);
  return current_;
}

void LiveTables::Reload(Listener done) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(done));
  }
  changed_.notify_one();
}

void LiveTables::Run() {
  while (true) {
    std::vector<Listener> listeners;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
      if (stopping_) return;
      listeners.swap(waiting_);
    }
    const ReloadResult result = ReloadNow();
    on_reload_(result);
    for (const Listener& listener : listeners) listener(result);
  }
}

LiveTables::ReloadResult LiveTables::ReloadNow() try {
  absl::StatusOr<TableCatalog::Reloaded> reloaded = current()->Reload();
  if (!reloaded.ok()) return reloaded.status();
  auto next = std::make_shared<const TableCatalog>(std::move(reloaded->catalog));
  {
    const std::lock_guard lock(mutex_);
    current_.swap(next);
  }
  // `next` is now the previous catalog, freed here unless calls still use it.
  return std::move(reloaded->changes);
} catch (const std::exception& error) {
  return absl::InternalError(error.what());
}

}  // namespace albtpu::server
