// Metrics of the process, under the names that all Prometheus clients use.
#pragma once

#include <prometheus/collectable.h>

#include <chrono>
#include <optional>
#include <vector>

namespace albtpu::server {

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

}  // namespace albtpu::server
