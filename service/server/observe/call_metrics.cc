#include "service/server/observe/call_metrics.h"

#include <string>

#include "absl/status/status.h"
#include "tables/schema.h"

namespace albtpu::server {
namespace {

// From a single pulse, tens of microseconds, to a full message behind many others.
const prometheus::Histogram::BucketBoundaries kSeconds = {25e-6,  50e-6, 100e-6, 250e-6, 500e-6, 1e-3,
                                                          2.5e-3, 5e-3,  10e-3,  25e-3,  50e-3,  0.1,
                                                          0.25,   0.5,   1,      2.5,    5,      10};
const prometheus::Histogram::BucketBoundaries kPulses = {1, 10, 100, 1000, 4096, 16384, 32768, 65536};

// Codes of which the first is to be noticed: a counter that appears at 1 has not risen, to Prometheus.
constexpr std::array kFromTheStart = {grpc::StatusCode::OK, grpc::StatusCode::INTERNAL,
                                      grpc::StatusCode::UNKNOWN, grpc::StatusCode::DATA_LOSS,
                                      grpc::StatusCode::RESOURCE_EXHAUSTED};

}  // namespace

std::string CodeName(grpc::StatusCode code) {
  const std::string name = absl::StatusCodeToString(static_cast<absl::StatusCode>(code));
  return name.empty() ? "UNKNOWN" : name;
}

CallMetrics::CallMetrics(prometheus::Registry& registry)
    : calls_(prometheus::BuildCounter()
                 .Name("albtpu_calls_total")
                 .Help("Calls that have ended, by method and status code.")
                 .Register(registry)) {
  auto& under_way = prometheus::BuildGauge()
                        .Name("albtpu_calls_under_way")
                        .Help("Calls that have begun and not ended.")
                        .Register(registry);
  auto& seconds = prometheus::BuildHistogram()
                      .Name("albtpu_answer_seconds")
                      .Help(
                          "Time from a request to its answer, without the network; in a stream, from the "
                          "moment that it is the turn of the request.")
                      .Register(registry);
  auto& batch = prometheus::BuildHistogram()
                    .Name("albtpu_answer_pulses")
                    .Help("Pulses of an answer.")
                    .Register(registry);
  auto& pulses = prometheus::BuildCounter()
                     .Name("albtpu_pulses_total")
                     .Help("Pulses that were answered, by outcome and the axis that made it.")
                     .Register(registry);
  for (std::size_t i = 0; i < kMethodNames.size(); ++i) {
    const prometheus::Labels method = {{"method", kMethodNames[i]}};
    for (const grpc::StatusCode code : kFromTheStart) Ended(static_cast<Method>(i), code);
    under_way_[i] = &under_way.Add(method);
    if (i >= kQueries) continue;
    seconds_[i] = &seconds.Add(method, kSeconds);
    pulses_[i] = &batch.Add(method, kPulses);
  }
  unread_ = &prometheus::BuildCounter()
                 .Name("albtpu_unread_answers_total")
                 .Help("Answers to single calls that were dropped: their callers did not read them.")
                 .Register(registry)
                 .Add({});
  interpolated_ = &pulses.Add({{"outcome", "INTERPOLATED"}, {"axis", ""}});
  for (AxisId axis : kAxes) {
    const std::string name(Describe(axis).name);
    out_of_domain_[Index(axis)] = &pulses.Add({{"outcome", "OUT_OF_DOMAIN"}, {"axis", name}});
    invalid_[Index(axis)] = &pulses.Add({{"outcome", "INVALID"}, {"axis", name}});
  }
}

void CallMetrics::CountEnd(Method method, grpc::StatusCode code) {
  under_way_[Index(method)]->Decrement();
  const auto number = static_cast<std::size_t>(code);
  Ended(method, number < kCodes ? number : static_cast<std::size_t>(grpc::StatusCode::UNKNOWN)).Increment();
}

void CallMetrics::CountAnswer(Method method, const OutcomeTally& tally, std::chrono::duration<double> took) {
  seconds_[Index(method)]->Observe(took.count());
  pulses_[Index(method)]->Observe(static_cast<double>(tally.pulses()));
  if (tally.interpolated > 0) interpolated_->Increment(static_cast<double>(tally.interpolated));
  if (tally.interpolated == tally.pulses()) return;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    if (tally.out_of_domain[i] > 0) out_of_domain_[i]->Increment(static_cast<double>(tally.out_of_domain[i]));
    if (tally.invalid[i] > 0) invalid_[i]->Increment(static_cast<double>(tally.invalid[i]));
  }
}

prometheus::Counter& CallMetrics::Ended(Method method, std::size_t code) {
  std::atomic<prometheus::Counter*>& place = ended_[Index(method)][code];
  prometheus::Counter* counter = place.load(std::memory_order_acquire);
  if (counter == nullptr) {  // Several threads that add the same one are given the same one.
    counter =
        &calls_.Add({{"method", Name(method)}, {"code", CodeName(static_cast<grpc::StatusCode>(code))}});
    place.store(counter, std::memory_order_release);
  }
  return *counter;
}

}  // namespace albtpu::server
