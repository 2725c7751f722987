// The options of a query, resolved: which table, and what to compute for each pulse.
#pragma once

#include "absl/status/statusor.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/server/calls/answer_sources.h"
#include "tables/query/column_query.h"

namespace albtpu::server {

struct QueryPlan {
  const ServedTable* source = nullptr;
  Query query;
  bool standard_errors = false;
  bool best_s44_order = false;

  bool asks_s44() const { return best_s44_order || query.s44_order.has_value(); }
};

// Fails as documented for `QueryOptions` and `SeaState`. `sea` is null if the request has none. The result refers to
// `sources`.
absl::StatusOr<QueryPlan> PlanQuery(const v1::QueryOptions& options, const v1::SeaState* sea,
                                    AnswerSources& sources);

// The same for a QueryPulsesRequest or a QueryColumnsRequest.
template <typename Request>
absl::StatusOr<QueryPlan> PlanQuery(const Request& request, AnswerSources& sources) {
  return PlanQuery(request.options(), request.has_sea() ? &request.sea() : nullptr, sources);
}

}  // namespace albtpu::server
