// The options of a query, resolved: which table, and what to compute for each pulse.
#pragma once

#include "absl/status/statusor.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/server/tables/table_catalog.h"
#include "tables/query/column_query.h"

namespace albtpu::server {

struct QueryPlan {
  const TableCatalog::Entry* source = nullptr;
  Query query;
  bool standard_errors = false;
  bool best_s44_order = false;

  bool asks_s44() const { return best_s44_order || query.s44_order.has_value(); }
};

// Fails as documented for `QueryOptions`. The result refers to `catalog`.
absl::StatusOr<QueryPlan> PlanQuery(const v1::QueryOptions& options, const TableCatalog& catalog);

}  // namespace albtpu::server
