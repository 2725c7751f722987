// What a request asks of each of its pulses.
#pragma once

#include "absl/status/statusor.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/server/tables/table_catalog.h"
#include "tables/query/column_query.h"

namespace albtpu::server {

// `QueryOptions`, read.
struct QueryPlan {
  const TableCatalog::Entry* source = nullptr;
  Query query;
  bool standard_errors = false;
  bool best_s44_order = false;

  bool asks_s44() const { return best_s44_order || query.s44_order.has_value(); }
};

// Fails as `QueryOptions` documents. The result refers to `catalog`.
absl::StatusOr<QueryPlan> PlanQuery(const v1::QueryOptions& options, const TableCatalog& catalog);

}  // namespace albtpu::server
