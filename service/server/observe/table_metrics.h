// The metrics of the tables in use, taken from the current catalog at every scrape.
#pragma once

#include <prometheus/collectable.h>

#include <vector>

#include "service/server/tables/live_tables.h"

namespace albtpu::server {

class TableMetrics final : public prometheus::Collectable {
 public:
  // `tables` must outlive this object.
  explicit TableMetrics(const LiveTables& tables) : tables_(tables) {}

  std::vector<prometheus::MetricFamily> Collect() const override;

 private:
  const LiveTables& tables_;
};

}  // namespace albtpu::server
