#include "service/server/observe/process_metrics.h"

#include <fcntl.h>
#include <prometheus/metric_family.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <system_error>

namespace albtpu::server {
namespace {

prometheus::MetricFamily Single(const char* name, const char* help, prometheus::MetricType type,
                                double value) {
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
    families.push_back(
        Gauge("process_virtual_memory_bytes", "Virtual memory size in bytes.", memory->virtual_bytes));
  }
  if (rusage usage; getrusage(RUSAGE_SELF, &usage) == 0) {
    families.push_back(Single("process_cpu_seconds_total", "Total user and system CPU time spent in seconds.",
                              prometheus::MetricType::Counter,
                              Seconds(usage.ru_utime) + Seconds(usage.ru_stime)));
  }
  if (const std::optional<double> files = CountOpenFiles(); files.has_value()) {
    families.push_back(Gauge("process_open_fds", "Number of open file descriptors.", *files));
  }
  if (rlimit limit; getrlimit(RLIMIT_NOFILE, &limit) == 0) {
    families.push_back(Gauge("process_max_fds", "Maximum number of open file descriptors.",
                             static_cast<double>(limit.rlim_cur)));
  }
  families.push_back(Gauge("process_start_time_seconds",
                           "Start time of the process since unix epoch in seconds.", start_time_));
  return families;
}

}  // namespace albtpu::server
