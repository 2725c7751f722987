#include "service/server/observe/metrics.h"

#include <fcntl.h>
#include <prometheus/metric_family.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "absl/status/status.h"
#include "tables/schema.h"
#include "tables/version.h"

namespace albtpu::server {
namespace {

prometheus::MetricFamily Single(const char* name, const char* help, prometheus::MetricType type, double value) {
  prometheus::ClientMetric metric;
  (type == prometheus::MetricType::Counter ? metric.counter.value : metric.gauge.value) = value;
  prometheus::MetricFamily family;
  family.name = name;
  family.help = help;
  family.type = type;
  family.metric = {metric};
  return family;
}

prometheus::MetricFamily Gauge(const char* name, const char* help, double value) {
  return Single(name, help, prometheus::MetricType::Gauge, value);
}

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

std::optional<double> CountOpenFiles() {
  std::error_code error;
  const std::filesystem::directory_iterator files("/proc/self/fd", error);
  if (error) return std::nullopt;
  return static_cast<double>(std::distance(begin(files), end(files)) - 1);  // Without the iterator's own.
}

}  // namespace

std::optional<ProcessMemory> ReadProcessMemory() {
  // proc(5): the first two numbers are in pages. The file is opened once, because opening takes longer than the rest.
  static const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  static const auto page = static_cast<double>(sysconf(_SC_PAGESIZE));
  char text[128];
  const ssize_t length = pread(file, text, sizeof text - 1, 0);
  if (length <= 0) return std::nullopt;
  text[length] = '\0';
  char* end = nullptr;
  const double virtual_pages = std::strtod(text, &end), resident_pages = std::strtod(end, nullptr);
  return ProcessMemory{.virtual_bytes = virtual_pages * page, .resident_bytes = resident_pages * page};
}

std::vector<prometheus::MetricFamily> ProcessMetrics::Collect() const {
  std::vector<prometheus::MetricFamily> families;
  if (const std::optional<ProcessMemory> memory = ReadProcessMemory(); memory.has_value()) {
    families.push_back(
        Gauge("process_resident_memory_bytes", "Resident memory size in bytes.", memory->resident_bytes));
    families.push_back(Gauge("process_virtual_memory_bytes", "Virtual memory size in bytes.", memory->virtual_bytes));
  }
  if (rusage usage; getrusage(RUSAGE_SELF, &usage) == 0) {
    families.push_back(Single("process_cpu_seconds_total", "Total user and system CPU time spent in seconds.",
                              prometheus::MetricType::Counter, Seconds(usage.ru_utime) + Seconds(usage.ru_stime)));
  }
  if (const std::optional<double> files = CountOpenFiles(); files.has_value())
    families.push_back(Gauge("process_open_fds", "Number of open file descriptors.", *files));
  if (rlimit limit; getrlimit(RLIMIT_NOFILE, &limit) == 0) {
    families.push_back(
        Gauge("process_max_fds", "Maximum number of open file descriptors.", static_cast<double>(limit.rlim_cur)));
  }
  families.push_back(
      Gauge("process_start_time_seconds", "Start time of the process since unix epoch in seconds.", start_time_));
  return families;
}

namespace {

// From a single pulse, tens of microseconds, to a full message that waits for many others.
const prometheus::Histogram::BucketBoundaries kSeconds = {
    25e-6, 50e-6, 100e-6, 250e-6, 500e-6, 1e-3, 2.5e-3, 5e-3, 10e-3, 25e-3, 50e-3, 0.1, 0.25, 0.5, 1, 2.5, 5, 10};
const prometheus::Histogram::BucketBoundaries kPulses = {1, 10, 100, 1000, 4096, 16384, 32768, 65536};

// Codes whose counters exist from the start, so that their first call is noticed: Prometheus sees no increase in a
// counter that appears at 1.
constexpr std::array kCodesFromStart = {grpc::StatusCode::OK, grpc::StatusCode::INTERNAL, grpc::StatusCode::UNKNOWN,
                                        grpc::StatusCode::DATA_LOSS, grpc::StatusCode::RESOURCE_EXHAUSTED};

bool HasChanges(const std::vector<TableCatalog::Change>& changes) {
  return std::any_of(changes.begin(), changes.end(), [](const TableCatalog::Change& change) {
    return change.kind != TableCatalog::Change::Kind::kKept;
  });
}

}  // namespace

std::string CodeName(grpc::StatusCode code) {
  const std::string name = absl::StatusCodeToString(static_cast<absl::StatusCode>(code));
  return name.empty() ? "UNKNOWN" : name;
}

CallMetrics::CallMetrics(prometheus::Registry& registry)
    : calls_(Counters(registry, "albtpu_calls_total", "Calls that have ended, by method and status code.")) {
  auto& in_progress = Gauges(registry, "albtpu_calls_under_way", "Calls that have begun and not ended.");
  auto& seconds = Histograms(registry, "albtpu_answer_seconds",
                             "Time from a request to its answer, without the network; in a stream, from the "
                             "moment that it is the turn of the request.");
  auto& batch = Histograms(registry, "albtpu_answer_pulses", "Pulses of an answer.");
  auto& pulses =
      Counters(registry, "albtpu_pulses_total", "Pulses that were answered, by outcome and the axis that made it.");
  for (std::size_t i = 0; i < kMethodNames.size(); ++i) {
    const prometheus::Labels method = {{"method", kMethodNames[i]}};
    for (const grpc::StatusCode code : kCodesFromStart) Ended(static_cast<Method>(i), code);
    in_progress_[i] = &in_progress.Add(method);
    if (i >= kPulseMethods) continue;
    seconds_[i] = &seconds.Add(method, kSeconds);
    pulses_[i] = &batch.Add(method, kPulses);
  }
  unread_ = &Counters(registry, "albtpu_unread_answers_total",
                      "Answers to single calls that were dropped: their callers did not read them.")
                 .Add({});
  interpolated_ = &pulses.Add({{"outcome", "INTERPOLATED"}, {"axis", ""}});
  for (AxisId axis : kAxes) {
    const std::string name(Describe(axis).name);
    out_of_domain_[Index(axis)] = &pulses.Add({{"outcome", "OUT_OF_DOMAIN"}, {"axis", name}});
    invalid_[Index(axis)] = &pulses.Add({{"outcome", "INVALID"}, {"axis", name}});
  }
  invalid_aircraft_ = &pulses.Add({{"outcome", "INVALID"}, {"axis", "aircraft"}});
}

void CallMetrics::CountEnd(Method method, grpc::StatusCode code) {
  in_progress_[Index(method)]->Decrement();
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
  if (tally.invalid_aircraft > 0) invalid_aircraft_->Increment(static_cast<double>(tally.invalid_aircraft));
}

prometheus::Counter& CallMetrics::Ended(Method method, std::size_t code) {
  std::atomic<prometheus::Counter*>& place = ended_[Index(method)][code];
  prometheus::Counter* counter = place.load(std::memory_order_acquire);
  if (counter == nullptr) {  // Threads that add the same counter at the same time get the same object.
    counter = &calls_.Add({{"method", Name(method)}, {"code", CodeName(static_cast<grpc::StatusCode>(code))}});
    place.store(counter, std::memory_order_release);
  }
  return *counter;
}

AccessMetrics::AccessMetrics(prometheus::Registry& registry)
    : certificate_expiry_(Gauges(registry, "albtpu_certificate_expiry_timestamp_seconds",
                                 "When the certificate ends that new connections are shown.")) {
  refused_connections_ = &Counters(registry, "albtpu_refused_connections_total",
                                   "Connections that were closed at once: there were as many as can be.")
                              .Add({});
  ended_connections_ = &Counters(registry, "albtpu_ended_connections_total",
                                 "Connections that were ended: they had more calls in memory than they may.")
                            .Add({});
  auto& calls = Counters(registry, "albtpu_refused_calls_total",
                         "Calls that were refused before they reached a method, by reason.");
  no_token_ = &calls.Add({{"reason", "no token"}});
  wrong_token_ = &calls.Add({{"reason", "wrong token"}});
}

ReloadMetrics::ReloadMetrics(prometheus::Registry& registry) {
  auto& reloads = Counters(registry, "albtpu_reloads_total", "Reloads of the tables, by result.");
  loaded_ = &reloads.Add({{"result", "loaded"}});
  unchanged_ = &reloads.Add({{"result", "unchanged"}});
  refused_ = &reloads.Add({{"result", "refused"}});
  last_succeeded_ = &Gauges(registry, "albtpu_last_reload_successful",
                            "1 if the last reload, or the start, took the tables as they lay on disk.")
                         .Add({}, 1);
  last_success_time_ = &Gauges(registry, "albtpu_last_reload_success_timestamp_seconds",
                               "When the tables were last taken as they lay on disk.")
                            .Add({});
  last_success_time_->SetToCurrentTime();
}

void ReloadMetrics::Count(const LiveTables::ReloadResult& result) {
  last_succeeded_->Set(result.ok() ? 1 : 0);
  if (!result.ok()) return refused_->Increment();
  last_success_time_->SetToCurrentTime();
  (HasChanges(*result) ? loaded_ : unchanged_)->Increment();
}

ServerMetrics::ServerMetrics() {
  Gauges(*registry, "albtpu_build_info", "1; which program this is.")
      .Add({{"version", std::string(Version())}, {"commit", std::string(Commit())}}, 1);
}

}  // namespace albtpu::server
