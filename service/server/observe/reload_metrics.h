// How reloads went, as metrics.
#pragma once

#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/registry.h>

#include "service/server/tables/live_tables.h"

namespace albtpu::server {

class ReloadMetrics {
 public:
  // Tables have just been loaded for the first time, which counts as a success, not as a reload.
  explicit ReloadMetrics(prometheus::Registry& registry);

  void Count(const LiveTables::Outcome& outcome);

 private:
  prometheus::Counter* loaded_;     // Tables have changed.
  prometheus::Counter* unchanged_;  // There was nothing to do.
  prometheus::Counter* refused_;    // The tables from before still answer.
  prometheus::Gauge* last_succeeded_;
  prometheus::Gauge* last_success_time_;
};

}  // namespace albtpu::server
