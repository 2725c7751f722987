// The metrics of seas, waters and tables, the count of outcomes, and the endpoint that Prometheus scrapes.
// docs/monitoring/README.md lists the metrics and explains their meaning.
#pragma once

#include <prometheus/collectable.h>
#include <prometheus/counter.h>
#include <prometheus/exposer.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "service/server/ground/listening_sockets.h"
#include "service/server/tables/table_catalog.h"
#include "tables/schema.h"

namespace albtpu::server {

// Metrics of one name, which differ by their labels.
inline prometheus::Family<prometheus::Counter>& Counters(prometheus::Registry& registry, const char* name,
                                                         const char* help) {
  return prometheus::BuildCounter().Name(name).Help(help).Register(registry);
}
inline prometheus::Family<prometheus::Gauge>& Gauges(prometheus::Registry& registry, const char* name,
                                                     const char* help) {
  return prometheus::BuildGauge().Name(name).Help(help).Register(registry);
}
inline prometheus::Family<prometheus::Histogram>& Histograms(prometheus::Registry& registry, const char* name,
                                                             const char* help) {
  return prometheus::BuildHistogram().Name(name).Help(help).Register(registry);
}

// The metrics of what is compiled for requests and kept: of the seas that they carry, or of the waters.
class CompileMetrics {
 public:
  // How a request got what it needed.
  void CountFound() { found_->Increment(); }    // It was kept.
  void CountJoined() { joined_->Increment(); }  // It was already asked for, and not yet compiled.
  void CountCompiled(std::chrono::duration<double> took);
  void CountFailed() { failed_->Increment(); }    // It cannot be compiled.
  void CountRefused() { refused_->Increment(); }  // There was no place to wait.

  void CountEvicted() { evicted_->Increment(); }
  void SetKept(std::size_t number, std::size_t bytes);

 protected:
  struct Metric {
    const char *name, *help;
  };
  CompileMetrics(prometheus::Registry& registry, Metric requests, Metric evictions, Metric seconds, Metric number,
                 Metric bytes);

 private:
  prometheus::Counter* found_;
  prometheus::Counter* joined_;
  prometheus::Counter* compiled_;
  prometheus::Counter* failed_;
  prometheus::Counter* refused_;
  prometheus::Counter* evicted_;
  prometheus::Histogram* seconds_;
  prometheus::Gauge* number_;
  prometheus::Gauge* bytes_;
};

class SeaMetrics : public CompileMetrics {
 public:
  explicit SeaMetrics(prometheus::Registry& registry);
};

class WaterMetrics : public CompileMetrics {
 public:
  explicit WaterMetrics(prometheus::Registry& registry);
};

// The metrics of the tables in use, taken from the current catalog at every scrape.

class TableMetrics final : public prometheus::Collectable {
 public:
  // `tables` must outlive this object.
  explicit TableMetrics(const LiveTables& tables) : tables_(tables) {}

  std::vector<prometheus::MetricFamily> Collect() const override;

 private:
  const LiveTables& tables_;
};

// Counts the pulses of an answer by outcome.

struct OutcomeTally {
  std::size_t interpolated = 0;
  // By the axis that caused the outcome.
  std::array<std::size_t, kAxisCount> out_of_domain = {};
  std::array<std::size_t, kAxisCount> invalid = {};
  std::size_t invalid_aircraft = 0;  // Caused by a number of the aircraft.

  std::size_t pulses() const;

  // Adds pulses given by their columns on the wire: the numbers of `Outcome` and `Axis`.
  void Add(std::span<const std::uint8_t> outcomes, std::span<const std::uint8_t> outcome_axes);
};

// The endpoint that Prometheus scrapes: plain HTTP, GET /metrics.

class MetricsEndpoint {
 public:
  // Listens until it is destroyed, and serves the metrics of all `sources` that still exist. Unavailable, with the
  // reason, if it cannot listen.
  static absl::StatusOr<std::unique_ptr<MetricsEndpoint>> Start(
      const ListenAddress& address, const std::vector<std::shared_ptr<prometheus::Collectable>>& sources);

  // HOST:PORT with the actual port.
  const std::string& address() const { return address_; }

 private:
  MetricsEndpoint(std::unique_ptr<prometheus::Exposer> exposer, std::string address)
      : exposer_(std::move(exposer)), address_(std::move(address)) {}

  std::unique_ptr<prometheus::Exposer> exposer_;
  std::string address_;
};

}  // namespace albtpu::server
