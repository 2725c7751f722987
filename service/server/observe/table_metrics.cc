#include "service/server/observe/table_metrics.h"

#include <prometheus/metric_family.h>

namespace albtpu::server {

std::vector<prometheus::MetricFamily> TableMetrics::Collect() const {
  const std::shared_ptr<const TableCatalog> catalog = tables_.current();
  const absl::StatusOr<const TableCatalog::Entry*> default_entry = catalog->Find("");
  prometheus::MetricFamily info;
  info.name = "albtpu_table_info";
  info.help = "1 for each table that answers; the digest is that of its content.";
  info.type = prometheus::MetricType::Gauge;
  for (const auto& entry : catalog->entries()) {
    const Provenance& provenance = entry->table.provenance();
    const bool is_default = default_entry.ok() && *default_entry == entry.get();
    prometheus::ClientMetric metric;
    metric.label = {{"name", entry->name},
                    {"id", provenance.id},
                    {"version", provenance.version},
                    {"digest", entry->table.digest()},
                    {"default", is_default ? "true" : "false"}};
    metric.gauge.value = 1;
    info.metric.push_back(std::move(metric));
  }
  return {std::move(info)};
}

}  // namespace albtpu::server
