#include "service/server/calls/query_plan.h"

#include "absl/strings/str_cat.h"
#include "service/server/ground/errors.h"
#include "service/server/tables/wire_enums.h"

namespace albtpu::server {
namespace {

absl::StatusOr<const ServedTable*> FindSource(const v1::QueryOptions& options, const v1::SeaState* sea,
                                              AnswerSources& sources) {
  if (sea == nullptr) return sources.Find(options.table());
  if (options.table().empty()) return sources.Find(*sea);
  return FieldViolation(
      "options.table", absl::StrCat("options.table is '", options.table(),
                                    "' (the request has a sea, whose table is another one); leave out one of "
                                    "the two"));
}

}  // namespace

absl::StatusOr<QueryPlan> PlanQuery(const v1::QueryOptions& options, const v1::SeaState* sea,
                                    AnswerSources& sources) {
  const absl::StatusOr<const ServedTable*> source = FindSource(options, sea, sources);
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
