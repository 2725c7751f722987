// Which tables answer, as metrics: taken from those that are current whenever somebody asks.
#pragma once

#include <prometheus/collectable.h>

#include <vector>

#include "service/server/tables/live_tables.h"

namespace albtpu::server {

class TableMetrics final : public prometheus::Collectable {
 public:
  // `tables` must outlive it.
  explicit TableMetrics(const LiveTables& tables) : tables_(tables) {}

  std::vector<prometheus::MetricFamily> Collect() const override;

 private:
  const LiveTables& tables_;
};

}  // namespace albtpu::server
