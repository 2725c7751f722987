// The record of a load on a server: pulses, latencies and processor time.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

namespace albtpu::bench {

using Clock = std::chrono::steady_clock;

inline double Seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

double OwnProcessorTime();        // s
double ProcessorTimeOf(int pid);  // s

// Ends the program with the message `what` unless `good`.
void Check(bool good, const std::string& what);

// Collects the pulses and latencies of all callers, and tells them when to stop.
class Record {
 public:
  explicit Record(double seconds)
      : end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}

  bool going_on() const { return Clock::now() < end_; }

  void Add(std::size_t pulses, const std::vector<double>& latencies) {
    const std::lock_guard lock(mutex_);
    pulses_ += pulses;
    latencies_.insert(latencies_.end(), latencies.begin(), latencies.end());
  }

  std::size_t pulses() const { return pulses_; }
  std::size_t calls() const { return latencies_.size(); }
  double Latency(double quantile) {
    if (latencies_.empty()) return 0;
    const auto nth =
        latencies_.begin() + static_cast<std::ptrdiff_t>(quantile * static_cast<double>(latencies_.size() - 1));
    std::nth_element(latencies_.begin(), nth, latencies_.end());
    return *nth;
  }

 private:
  const Clock::time_point end_;
  std::mutex mutex_;
  std::size_t pulses_ = 0;
  std::vector<double> latencies_;
};

}  // namespace albtpu::bench
