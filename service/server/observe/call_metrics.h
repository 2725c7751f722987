// What calls add to the metrics: a few atomic additions for each call and each answer, none for a pulse.
#pragma once

#include <grpcpp/grpcpp.h>
#include <prometheus/counter.h>
#include <prometheus/family.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>

#include <array>
#include <atomic>
#include <chrono>
#include <string>

#include "service/server/ground/method.h"
#include "service/server/observe/outcome_tally.h"

namespace albtpu::server {

// As gRPC spells it: INVALID_ARGUMENT.
std::string CodeName(grpc::StatusCode code);

// docs/monitoring/README.md lists the metrics and their meaning.
class CallMetrics {
 public:
  explicit CallMetrics(prometheus::Registry& registry);

  void CountBegin(Method method) { under_way_[Index(method)]->Increment(); }
  void CountEnd(Method method, grpc::StatusCode code);
  // An answer of one of the methods that take pulses; of a stream, one of its answers.
  void CountAnswer(Method method, const OutcomeTally& tally, std::chrono::duration<double> took);
  // An answer of a call that has ended well, as far as the server can see, was not taken.
  void CountUnread() { unread_->Increment(); }

 private:
  static constexpr std::size_t kCodes = 17;   // gRPC's, from OK to UNAUTHENTICATED.
  static constexpr std::size_t kQueries = 3;  // The methods that take pulses are the first.

  using AxisCounters = std::array<prometheus::Counter*, kAxisCount>;

  prometheus::Counter& Ended(Method method, std::size_t code);

  prometheus::Family<prometheus::Counter>& calls_;
  // Most are made when they are first needed: most never are.
  std::array<std::array<std::atomic<prometheus::Counter*>, kCodes>, kMethodNames.size()> ended_ = {};
  std::array<prometheus::Gauge*, kMethodNames.size()> under_way_;
  std::array<prometheus::Histogram*, kQueries> seconds_;
  std::array<prometheus::Histogram*, kQueries> pulses_;
  prometheus::Counter* unread_;
  prometheus::Counter* interpolated_;
  AxisCounters out_of_domain_;
  AxisCounters invalid_;
};

}  // namespace albtpu::server
