// The metrics of the process, of calls, access and reloads. docs/monitoring/README.md lists them and explains their
// meaning.
#pragma once

#include <grpcpp/grpcpp.h>
#include <prometheus/collectable.h>
#include <prometheus/counter.h>
#include <prometheus/family.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <ctime>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "service/server/observe/metric_collectors.h"
#include "service/server/tables/table_catalog.h"

namespace albtpu::server {

// Metrics of the process, under the names that all Prometheus clients use.

struct ProcessMemory {
  double virtual_bytes, resident_bytes;
};

// The memory of this process now; none if /proc cannot be read.
std::optional<ProcessMemory> ReadProcessMemory();

// Read from /proc at every scrape; what cannot be read is left out. Construct it when the process starts, because the
// start time is that of construction.
class ProcessMetrics final : public prometheus::Collectable {
 public:
  std::vector<prometheus::MetricFamily> Collect() const override;

 private:
  const double start_time_ =  // s since 1970-01-01 UTC
      std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
};

// The methods that appear in the log and the metrics. Those that take pulses come first.
enum class Method {
  kQueryPulses,
  kQueryColumns,
  kStreamColumns,
  kQueryBudget,
  kListTables,
  kGetTable,
  kCompileSea,
  kReloadTables
};

inline constexpr std::array<const char*, 8> kMethodNames = {"QueryPulses", "QueryColumns", "StreamColumns",
                                                            "QueryBudget", "ListTables",   "GetTable",
                                                            "CompileSea",  "ReloadTables"};

constexpr std::size_t Index(Method method) { return static_cast<std::size_t>(method); }
constexpr const char* Name(Method method) { return kMethodNames[Index(method)]; }

// As gRPC spells it: INVALID_ARGUMENT.
std::string CodeName(grpc::StatusCode code);

// Calls and their answers. Counting costs a few atomic additions for each call and each answer, none for a pulse.
class CallMetrics {
 public:
  explicit CallMetrics(prometheus::Registry& registry);

  void CountBegin(Method method) { in_progress_[Index(method)]->Increment(); }
  void CountEnd(Method method, grpc::StatusCode code);
  // Counts one answer of a method that takes pulses; a stream has many.
  void CountAnswer(Method method, const OutcomeTally& tally, std::chrono::duration<double> took);
  // Counts an answer that the caller did not read, although the call itself ended with OK.
  void CountUnread() { unread_->Increment(); }

 private:
  static constexpr std::size_t kCodes = 17;  // Of gRPC, from OK to UNAUTHENTICATED.
  static constexpr std::size_t kPulseMethods = 4;

  using AxisCounters = std::array<prometheus::Counter*, kAxisCount>;

  prometheus::Counter& Ended(Method method, std::size_t code);

  prometheus::Family<prometheus::Counter>& calls_;
  // Most counters are created on first use, because most are never needed.
  std::array<std::array<std::atomic<prometheus::Counter*>, kCodes>, kMethodNames.size()> ended_ = {};
  std::array<prometheus::Gauge*, kMethodNames.size()> in_progress_;
  std::array<prometheus::Histogram*, kPulseMethods> seconds_;
  std::array<prometheus::Histogram*, kPulseMethods> pulses_;
  prometheus::Counter* unread_;
  prometheus::Counter* interpolated_;
  AxisCounters out_of_domain_;
  AxisCounters invalid_;
  prometheus::Counter* invalid_aircraft_;
};

// Connections and calls that were refused before they reached a method, and the expiry of the certificate.
class AccessMetrics {
 public:
  explicit AccessMetrics(prometheus::Registry& registry);

  // A connection that was refused because there was no room for it.
  void CountRefusedConnection() { refused_connections_->Increment(); }

  // A connection that was closed because it had too many calls in memory.
  void CountEndedConnection() { ended_connections_->Increment(); }

  // Calls without a token, or with one that is not accepted.
  void CountNoToken() { no_token_->Increment(); }
  void CountWrongToken() { wrong_token_->Increment(); }

  // Expiry of the certificate for new connections. A server without a certificate does not have this metric.
  void SetCertificateExpiry(std::time_t expiry) { certificate_expiry_.Add({}).Set(static_cast<double>(expiry)); }

 private:
  prometheus::Counter* refused_connections_;
  prometheus::Counter* ended_connections_;
  prometheus::Counter* no_token_;
  prometheus::Counter* wrong_token_;
  prometheus::Family<prometheus::Gauge>& certificate_expiry_;
};

class ReloadMetrics {
 public:
  // The first load of the tables, just before, counts as a success but not as a reload.
  explicit ReloadMetrics(prometheus::Registry& registry);

  void Count(const LiveTables::ReloadResult& result);

 private:
  prometheus::Counter* loaded_;     // Tables have changed.
  prometheus::Counter* unchanged_;  // No file has changed.
  prometheus::Counter* refused_;    // The previous tables stay in use.
  prometheus::Gauge* last_succeeded_;
  prometheus::Gauge* last_success_time_;
};

// All metrics of a server except those of its tables (metric_collectors.h).
struct ServerMetrics {
  ServerMetrics();

  std::shared_ptr<ProcessMetrics> process = std::make_shared<ProcessMetrics>();
  std::shared_ptr<prometheus::Registry> registry = std::make_shared<prometheus::Registry>();
  CallMetrics calls{*registry};
  AccessMetrics access{*registry};
  ReloadMetrics reloads{*registry};
  SeaMetrics seas{*registry};
  WaterMetrics waters{*registry};
};

}  // namespace albtpu::server
