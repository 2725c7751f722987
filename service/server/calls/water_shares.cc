#include "service/server/calls/water_shares.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>

#include "absl/strings/str_cat.h"
#include "service/server/ground/errors.h"

namespace albtpu::server {
namespace {

// A quarter of the cores, beside the half of seas: waters never keep the answers from tables waiting.
std::size_t ThreadsOfWaters() { return std::max(1u, std::thread::hardware_concurrency() / 4); }

// On this thread alone.
absl::StatusOr<CompiledWater> CompileHere(const WaterColumnTable* table, const KnownWater& water) {
  return tbb::task_arena(1).execute([&] { return CompileWater(table, water); });
}

v1::WaterSummary SummaryOf(const WaterColumnTable* table, const KnownWater& water, const CompiledWater& compiled) {
  v1::WaterSummary summary;
  if (compiled.share != nullptr) {
    const Provenance& provenance = table->table().provenance();
    summary.mutable_table()->set_id(provenance.id);
    summary.mutable_table()->set_version(provenance.version);
    summary.mutable_table()->set_digest(table->table().digest());
    summary.set_greatest_depth(compiled.share->greatest_depth());
    summary.set_greatest_incidence(compiled.share->greatest_incidence());
    summary.set_greatest_footprint(compiled.share->greatest_footprint());
  }
  if (compiled.optics.has_value()) {
    summary.set_attenuation(compiled.optics->attenuation);
    summary.set_attenuation_log_sigma(compiled.optics->attenuation_log_sigma);
    const OpticsText text = TextOf(water.optics);
    summary.set_derivation(absl::StrCat(text.entered, "; ", text.formula));
  }
  if (compiled.surface.has_value()) summary.set_green_surface_range(compiled.surface->mean);
  for (const std::string& assumption : AssumptionsOf(water, compiled)) summary.add_assumptions(assumption);
  return summary;
}

std::size_t BytesOfWater(const ServedWater& served) {
  return sizeof(ServedWater) + (served.water.share == nullptr ? 0 : served.water.share->memory());
}

}  // namespace

WaterShares::WaterShares(WaterMetrics& metrics, CallLog& log, const Limits& limits)
    : metrics_(metrics),
      log_(log),
      queue_(
          metrics,
          {.threads = ThreadsOfWaters(), .values = limits.waters, .bytes = limits.bytes, .waiting = limits.waiting},
          "the server cannot take another water (too many wait to be computed); try again later",
          [this](const WantedWater& wanted) { return Make(wanted); }, BytesOfWater) {}

WaterShares::Result WaterShares::Make(const WantedWater& wanted) {
  const auto begin = std::chrono::steady_clock::now();
  const WaterColumnTable* const table = wanted.table == nullptr ? nullptr : &wanted.table->table;
  absl::StatusOr<CompiledWater> compiled = CompileHere(table, wanted.water);
  if (!compiled.ok()) {
    metrics_.CountFailed();
    if (!absl::IsInvalidArgument(compiled.status())) return compiled.status();
    return FieldViolation("water", absl::StrCat("water: ", std::string(compiled.status().message())));
  }
  v1::WaterSummary summary = SummaryOf(table, wanted.water, *compiled);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  metrics_.CountCompiled(took);
  log_.Write(spdlog::level::info, "water compiled",
             {{"attenuation", summary.attenuation()},
              {"greatest_depth", summary.greatest_depth()},
              {"seconds", took.count()}});
  return std::make_shared<const ServedWater>(ServedWater{*std::move(compiled), std::move(summary)});
}

}  // namespace albtpu::server
