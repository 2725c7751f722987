#include "service/server/calls/query_plan.h"

#include "service/server/tables/wire_enums.h"

namespace albtpu::server {

absl::StatusOr<QueryPlan> PlanQuery(const v1::QueryOptions& options, const TableCatalog& catalog) {
  const absl::StatusOr<const TableCatalog::Entry*> source = catalog.Find(options.table());
  if (!source.ok()) return source.status();
  const absl::StatusOr<Coverage> coverage = FromWire(options.coverage());
  if (!coverage.ok()) return coverage.status();
  const absl::StatusOr<std::optional<S44Order>> s44_order = FromWire(options.s44_order());
  if (!s44_order.ok()) return s44_order.status();
  return QueryPlan{.source = *source,
                   .query = {.coverage = *coverage, .s44_order = *s44_order},
                   .standard_errors = options.standard_errors(),
                   .best_s44_order = options.best_s44_order()};
}

}  // namespace albtpu::server
