#include "service/server/observe/metric_collectors.h"

#include <prometheus/metric_family.h>

#include <algorithm>
#include <cassert>
#include <exception>
#include <numeric>

#include "absl/strings/str_cat.h"
#include "albtpu/v1/uncertainty.pb.h"
#include "service/server/ground/limits.h"

namespace albtpu::server {
namespace {

// From a sea on an idle machine, some milliseconds, to a water on a busy machine.
const prometheus::Histogram::BucketBoundaries kCompileSeconds = {2.5e-3, 5e-3, 10e-3, 25e-3, 50e-3, 0.1,
                                                                 0.25,   0.5,  1,     2.5,   5};

}  // namespace

CompileMetrics::CompileMetrics(prometheus::Registry& registry, Metric requests, Metric evictions, Metric seconds,
                               Metric number, Metric bytes) {
  auto& by_result = Counters(registry, requests.name, requests.help);
  found_ = &by_result.Add({{"result", "found"}});
  joined_ = &by_result.Add({{"result", "joined"}});
  compiled_ = &by_result.Add({{"result", "compiled"}});
  failed_ = &by_result.Add({{"result", "failed"}});
  refused_ = &by_result.Add({{"result", "refused"}});
  evicted_ = &Counters(registry, evictions.name, evictions.help).Add({});
  seconds_ = &Histograms(registry, seconds.name, seconds.help).Add({}, kCompileSeconds);
  number_ = &Gauges(registry, number.name, number.help).Add({});
  bytes_ = &Gauges(registry, bytes.name, bytes.help).Add({});
}

void CompileMetrics::CountCompiled(std::chrono::duration<double> took) {
  compiled_->Increment();
  seconds_->Observe(took.count());
}

void CompileMetrics::SetKept(std::size_t number, std::size_t bytes) {
  number_->Set(static_cast<double>(number));
  bytes_->Set(static_cast<double>(bytes));
}

SeaMetrics::SeaMetrics(prometheus::Registry& registry)
    : CompileMetrics(registry, {"albtpu_sea_requests_total", "Requests with a sea, by how they got its table."},
                     {"albtpu_sea_evictions_total", "Tables of seas that were dropped to make room for others."},
                     {"albtpu_sea_compile_seconds", "Time to compute the table of a sea, without waiting."},
                     {"albtpu_sea_tables", "Tables of seas that are kept."},
                     {"albtpu_sea_table_bytes", "Memory of the tables of seas that are kept."}) {}

WaterMetrics::WaterMetrics(prometheus::Registry& registry)
    : CompileMetrics(registry, {"albtpu_water_requests_total", "Requests with a water, by how they got its share."},
                     {"albtpu_water_evictions_total", "Waters that were dropped to make room for others."},
                     {"albtpu_water_compile_seconds", "Time to compute a water, without waiting."},
                     {"albtpu_waters", "Waters that are kept."},
                     {"albtpu_water_bytes", "Memory of the waters that are kept."}) {}

std::vector<prometheus::MetricFamily> TableMetrics::Collect() const {
  const std::shared_ptr<const TableCatalog> catalog = tables_.current();
  const absl::StatusOr<const TableCatalog::Entry*> default_entry = catalog->Find("");
  prometheus::MetricFamily info;
  info.name = "albtpu_table_info";
  info.help = "1 for each table that answers; the digest is that of its content.";
  info.type = prometheus::MetricType::Gauge;
  for (const auto& entry : catalog->entries()) {
    const Provenance& provenance = entry->table.provenance();
    const bool is_default = default_entry.ok() && *default_entry == entry.get();
    prometheus::ClientMetric metric;
    metric.label = {{"name", entry->name},
                    {"id", provenance.id},
                    {"version", provenance.version},
                    {"digest", entry->table.digest()},
                    {"default", is_default ? "true" : "false"}};
    metric.gauge.value = 1;
    info.metric.push_back(std::move(metric));
  }
  return {std::move(info)};
}

std::size_t OutcomeTally::pulses() const {
  const std::size_t out = std::accumulate(out_of_domain.begin(), out_of_domain.end(), std::size_t{0});
  return std::accumulate(invalid.begin(), invalid.end(), interpolated + out + invalid_aircraft);
}

void OutcomeTally::Add(std::span<const std::uint8_t> outcomes, std::span<const std::uint8_t> outcome_axes) {
  assert(outcomes.size() == outcome_axes.size());
  const auto count = static_cast<std::size_t>(
      std::count(outcomes.begin(), outcomes.end(), static_cast<std::uint8_t>(v1::OUTCOME_INTERPOLATED)));
  interpolated += count;
  if (count == outcomes.size()) return;  // The usual case.
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (outcomes[i] == v1::OUTCOME_INTERPOLATED) continue;
    if (outcome_axes[i] == v1::AXIS_UNSPECIFIED) {
      ++invalid_aircraft;
      continue;
    }
    auto& by_axis = outcomes[i] == v1::OUTCOME_OUT_OF_DOMAIN ? out_of_domain : invalid;
    ++by_axis[outcome_axes[i] - static_cast<std::size_t>(v1::AXIS_WIND_SPEED)];
  }
}

absl::StatusOr<std::unique_ptr<MetricsEndpoint>> MetricsEndpoint::Start(
    const ListenAddress& address, const std::vector<std::shared_ptr<prometheus::Collectable>>& sources) {
  // Tried first for the reason of a failure, which the library does not give.
  const absl::Status probe = Listen(address).status();
  if (!probe.ok()) return absl::UnavailableError(absl::StrCat("cannot listen on ", probe.message()));
  try {
    auto exposer = std::make_unique<prometheus::Exposer>(
        std::vector<std::string>{"listening_ports", address.ToString(), "num_threads", std::to_string(kMetricsThreads),
                                 "request_timeout_ms", std::to_string(kMetricsTimeout.count())});
    // Without the end of the pattern, every path that begins so has them.
    for (const auto& source : sources) exposer->RegisterCollectable(source, "/metrics$");
    std::string bound = address.WithPort(exposer->GetListeningPorts().front());
    return std::unique_ptr<MetricsEndpoint>(new MetricsEndpoint(std::move(exposer), std::move(bound)));
  } catch (const std::exception& error) {
    return absl::UnavailableError(absl::StrCat("cannot listen on ", address.ToString(), ": ", error.what()));
  }
}

}  // namespace albtpu::server
