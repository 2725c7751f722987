#include "service/server/tables/table_catalog.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "absl/strings/str_cat.h"
#include "status/status_macros.h"
#include "tables/file/table_io.h"

namespace albtpu::server {
namespace {

using Kind = TableCatalog::Change::Kind;

absl::StatusOr<std::shared_ptr<const TableCatalog::Entry>> Read(const TableFile& file) {
  // Taken before the content is read, so a change during the read is noticed the next time.
  const FileIdentity identity = IdentityOf(file.path);
  ASSIGN_OR_RETURN(UncertaintyTable table, ReadTable(file.path));
  return std::make_shared<const TableCatalog::Entry>(
      TableCatalog::Entry{{file.FullName(), std::move(table)}, identity});
}

absl::StatusOr<std::shared_ptr<const TableCatalog::Water>> ReadWater(const std::filesystem::path& path) {
  const FileIdentity identity = IdentityOf(path);
  ASSIGN_OR_RETURN(Table table, ReadTable(path, kWaterColumn));
  ASSIGN_OR_RETURN(WaterColumnTable water, WaterColumnTable::Create(std::move(table)));
  return std::make_shared<const TableCatalog::Water>(TableCatalog::Water{path, std::move(water), identity});
}

// Joins the messages of several failures.
class Failures {
 public:
  void Add(const absl::Status& status) {
    const absl::string_view before = all_.message();
    all_ = absl::Status(all_.ok() ? status.code() : all_.code(),
                        absl::StrCat(before, before.empty() ? "" : "; ", status.message()));
  }
  const absl::Status& all() const { return all_; }

 private:
  absl::Status all_;
};

absl::Status CheckNames(const std::vector<TableFile>& files, const std::filesystem::path& folder,
                        std::string_view default_table) {
  if (files.empty()) {
    return absl::NotFoundError(
        absl::StrCat("there is no table in '", folder.string(), "': expected NAME.h5 or NAME/VERSION.h5"));
  }
  if (default_table.empty()) return absl::OkStatus();
  const absl::Status found = FindTable(files, default_table).status();
  if (found.ok()) return found;
  return absl::Status(found.code(), absl::StrCat("default table: ", found.message()));
}

}  // namespace

absl::StatusOr<TableCatalog> TableCatalog::Load(const std::filesystem::path& folder, std::string_view default_table) {
  ASSIGN_OR_RETURN(Reloaded first, TableCatalog(folder, default_table).Reload());
  return std::move(first.catalog);
}

absl::Status TableCatalog::AddWater(const std::filesystem::path& file) {
  ASSIGN_OR_RETURN(water_, ReadWater(file));
  return absl::OkStatus();
}

absl::StatusOr<TableCatalog::Reloaded> TableCatalog::Reload() const {
  ASSIGN_OR_RETURN(std::vector<TableFile> files, FindTables(folder_));
  RETURN_IF_ERROR(CheckNames(files, folder_, default_table_));
  Reloaded reloaded{TableCatalog(folder_, default_table_), {}};
  TableCatalog& catalog = reloaded.catalog;
  Failures failures;
  for (TableFile& file : files) {
    std::shared_ptr<const Entry> entry = EntryOf(file.FullName());
    const bool is_kept = entry != nullptr && entry->identity == IdentityOf(file.path);
    if (!is_kept) {
      absl::StatusOr<std::shared_ptr<const Entry>> read = Read(file);
      if (!read.ok()) {
        failures.Add(read.status());
        continue;
      }
      entry = *std::move(read);
    }
    reloaded.changes.push_back({entry->name, is_kept ? Kind::kKept : Kind::kLoaded});
    file.published = entry->table.is_published();
    catalog.files_.push_back(std::move(file));
    catalog.entries_.push_back(std::move(entry));
  }
  if (water_ != nullptr) {
    const bool is_kept = water_->identity == IdentityOf(water_->path);
    absl::StatusOr<std::shared_ptr<const Water>> read = is_kept ? water_ : ReadWater(water_->path);
    if (read.ok())
      catalog.water_ = *std::move(read);
    else
      failures.Add(read.status());
  }
  if (!failures.all().ok()) return failures.all();
  for (const std::shared_ptr<const Entry>& entry : entries_)
    if (catalog.EntryOf(entry->name) == nullptr) reloaded.changes.push_back({entry->name, Kind::kRemoved});
  return reloaded;
}

std::shared_ptr<const TableCatalog::Entry> TableCatalog::EntryOf(std::string_view name) const {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const auto& entry) { return entry->name == name; });
  return found == entries_.end() ? nullptr : *found;
}

absl::StatusOr<const TableCatalog::Entry*> TableCatalog::Find(std::string_view request) const {
  ASSIGN_OR_RETURN(const std::size_t found, FindTable(files_, request, default_table_));
  return entries_[found].get();
}

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
  ASSIGN_OR_RETURN(TableCatalog::Reloaded reloaded, current()->Reload());
  auto next = std::make_shared<const TableCatalog>(std::move(reloaded.catalog));
  {
    const std::lock_guard lock(mutex_);
    current_.swap(next);
  }
  // `next` is now the previous catalog, freed here unless calls still use it.
  return std::move(reloaded.changes);
} catch (const std::exception& error) {
  return absl::InternalError(error.what());
}

}  // namespace albtpu::server
