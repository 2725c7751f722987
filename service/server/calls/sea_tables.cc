#include "service/server/calls/sea_tables.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "absl/status/status.h"
#include "service/server/ground/errors.h"

namespace albtpu::server {
namespace {

// Half of the cores: seas never keep the answers from tables waiting.
std::size_t ThreadCount() { return std::max(1u, std::thread::hardware_concurrency() / 2); }

// The bytes of a table and of its interpolator, which holds every number again.
std::size_t BytesOf(const UncertaintyTable& table) {
  std::size_t numbers = 0;
  for (const Quantity quantity : kQuantities) {
    const Variable* const variable = table.variable(quantity);
    if (variable != nullptr) numbers += variable->values.size() + variable->standard_errors.size();
  }
  return 2 * numbers * sizeof(float);
}

}  // namespace

SeaTables::SeaTables(SeaMetrics& metrics, CallLog& log, const Limits& limits)
    : limits_(limits), metrics_(metrics), log_(log) {
  for (std::size_t i = 0; i < ThreadCount(); ++i) threads_.emplace_back([this] { Run(); });
}

SeaTables::~SeaTables() {
  Asked left;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    for (const WantedTable& wanted : std::exchange(waiting_, {})) left.insert(asked_.extract(wanted.key));
  }
  changed_.notify_all();
  for (const auto& [key, listeners] : left)
    for (const Listener& done : listeners) done(absl::CancelledError("the server is shutting down"));
  for (std::thread& thread : threads_) thread.join();
}

std::shared_ptr<const ServedTable> SeaTables::Find(const Sha256Digest& key) {
  const std::lock_guard lock(mutex_);
  return FindKept(key);
}

void SeaTables::Compile(const WantedTable& wanted, Listener done) {
  const Sha256Digest& key = wanted.key;
  Result result = absl::ResourceExhaustedError(
      "the server cannot take another sea (too many wait to be computed); try again later");
  {
    const std::lock_guard lock(mutex_);
    if (std::shared_ptr<const ServedTable> kept = FindKept(key)) {
      result = std::move(kept);
    } else if (const auto asked = asked_.find(key); asked != asked_.end()) {
      metrics_.CountJoined();
      return asked->second.push_back(std::move(done));
    } else if (waiting_.size() < limits_.waiting) {
      asked_[key].push_back(std::move(done));
      waiting_.push_back(wanted);
      return changed_.notify_one();
    } else {
      metrics_.CountRefused();
    }
  }
  done(result);
}

void SeaTables::Run() {
  while (true) {
    WantedTable next;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
      if (stopping_) return;
      next = std::move(waiting_.front());
      waiting_.pop_front();
    }
    const Result result = Make(next);
    std::vector<Listener> listeners;
    {
      const std::lock_guard lock(mutex_);
      if (result.ok()) Keep(next.key, *result);
      listeners = std::move(asked_.extract(next.key).mapped());
    }
    for (const Listener& done : listeners) done(result);
  }
}

SeaTables::Result SeaTables::Make(const WantedTable& wanted) try {
  if (const KnownSea* const sea = std::get_if<KnownSea>(&wanted.of)) return CompileNow(*sea, wanted.refractive_index);
  const ServedTable& served = *std::get<std::shared_ptr<const ServedTable>>(wanted.of);
  return std::make_shared<const ServedTable>(served.name, served.table, wanted.refractive_index);
} catch (const std::exception& error) {
  metrics_.CountFailed();
  return absl::InternalError(error.what());
}

SeaTables::Result SeaTables::CompileNow(const KnownSea& sea, double index) {
  const auto begin = std::chrono::steady_clock::now();
  absl::StatusOr<UncertaintyTable> table = CompileSea(compiler_, sea, index);
  if (!table.ok()) {
    metrics_.CountFailed();
    if (!absl::IsInvalidArgument(table.status())) return table.status();
    return FieldViolation("sea", std::string(table.status().message()));
  }
  auto compiled = std::make_shared<const ServedTable>("", *std::move(table), index);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  metrics_.CountCompiled(took);
  log_.Write(spdlog::level::info, "sea compiled",
             {{"digest", compiled->table.digest()},
              {"significant_wave_height", compiled->sea->significant_wave_height},
              {"wind_speed", compiled->sea->wind_speed_10m},
              {"share_measured", compiled->sea->share_measured},
              {"seconds", took.count()}});
  return compiled;
}

std::shared_ptr<const ServedTable> SeaTables::FindKept(const Sha256Digest& key) {
  const auto place = places_.find(key);
  if (place == places_.end()) return nullptr;
  metrics_.CountFound();
  kept_.splice(kept_.begin(), kept_, place->second);
  return place->second->table;
}

void SeaTables::Keep(const Sha256Digest& key, const std::shared_ptr<const ServedTable>& table) {
  kept_.push_front({key, table, BytesOf(table->table)});
  places_[key] = kept_.begin();
  kept_bytes_ += kept_.front().bytes;
  while (kept_.size() > 1 && (kept_.size() > limits_.tables || kept_bytes_ > limits_.bytes)) {
    kept_bytes_ -= kept_.back().bytes;
    places_.erase(kept_.back().key);
    kept_.pop_back();
    metrics_.CountEvicted();
  }
  metrics_.SetKept(kept_.size(), kept_bytes_);
}

}  // namespace albtpu::server
