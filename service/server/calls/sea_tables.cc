#include "service/server/calls/sea_tables.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>

#include "absl/status/status.h"
#include "service/server/ground/errors.h"

namespace albtpu::server {
namespace {

// Half of the cores: seas never keep the answers from tables waiting.
std::size_t ThreadsOfTables() { return std::max(1u, std::thread::hardware_concurrency() / 2); }

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
    : metrics_(metrics),
      log_(log),
      queue_(
          metrics,
          {.threads = ThreadsOfTables(), .values = limits.tables, .bytes = limits.bytes, .waiting = limits.waiting},
          "the server cannot take another sea (too many wait to be computed); try again later",
          [this](const WantedTable& wanted) { return Make(wanted); },
          [](const ServedTable& table) { return BytesOf(table.table); }) {}

SeaTables::Result SeaTables::Make(const WantedTable& wanted) {
  if (const KnownSea* const sea = std::get_if<KnownSea>(&wanted.of)) return CompileNow(*sea, wanted.refractive_index);
  const ServedTable& served = *std::get<std::shared_ptr<const ServedTable>>(wanted.of);
  return std::make_shared<const ServedTable>(served.name, served.table, wanted.refractive_index);
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

}  // namespace albtpu::server
