// The process as metrics, under the names that all clients of Prometheus use.
#pragma once

#include <prometheus/collectable.h>

#include <chrono>
#include <optional>
#include <vector>

namespace albtpu::server {

struct ProcessMemory {
  double virtual_bytes, resident_bytes;
};

// What this process has now; none where /proc does not say it.
std::optional<ProcessMemory> ReadProcessMemory();

// Read from /proc whenever somebody asks; what cannot be read is left out. To be made when the process
// begins.
class ProcessMetrics final : public prometheus::Collectable {
 public:
  std::vector<prometheus::MetricFamily> Collect() const override;

 private:
  const double start_time_ =  // s since 1970
      std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
};

}  // namespace albtpu::server
