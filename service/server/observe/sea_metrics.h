// The metrics of the seas that requests carry. docs/monitoring/README.md lists them and explains their meaning.
#pragma once

#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>

#include <chrono>
#include <cstddef>

namespace albtpu::server {

class SeaMetrics {
 public:
  explicit SeaMetrics(prometheus::Registry& registry);

  // How a request got the table of its sea.
  void CountFound() { found_->Increment(); }    // It was kept.
  void CountJoined() { joined_->Increment(); }  // The sea was already asked for, and not yet compiled.
  void CountCompiled(std::chrono::duration<double> took);
  void CountFailed() { failed_->Increment(); }    // The sea has no table.
  void CountRefused() { refused_->Increment(); }  // There was no place to wait.

  void CountEvicted() { evicted_->Increment(); }
  void SetKept(std::size_t tables, std::size_t bytes);

 private:
  prometheus::Counter* found_;
  prometheus::Counter* joined_;
  prometheus::Counter* compiled_;
  prometheus::Counter* failed_;
  prometheus::Counter* refused_;
  prometheus::Counter* evicted_;
  prometheus::Histogram* seconds_;
  prometheus::Gauge* tables_;
  prometheus::Gauge* bytes_;
};

}  // namespace albtpu::server
