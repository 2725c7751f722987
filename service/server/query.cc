#include "service/server/query.h"

#include "service/server/wire_enums.h"

namespace albtpu::server {
namespace {

std::optional<float> Remaining(double limit, float ours) {
  const std::optional<double> remaining = RemainingBudget(limit, ours);
  if (!remaining.has_value()) return std::nullopt;
  return static_cast<float>(*remaining);
}

S44Answer AnswerS44(const Query& query, const PulseUncertainty& p95, float depth) {
  const float thu = p95[Quantity::kThu], tvu = p95[Quantity::kTvu];
  S44Answer answer;
  if (query.best_s44_order) answer.best_order = BestOrder(thu, tvu, depth);
  if (query.s44_order.has_value()) {
    answer.remaining_thu = Remaining(ThuLimit(*query.s44_order, depth), thu);
    answer.remaining_tvu = Remaining(TvuLimit(*query.s44_order, depth), tvu);
  }
  return answer;
}

}  // namespace

absl::StatusOr<Query> ReadOptions(const v1::QueryOptions& options, const TableCatalog& catalog) {
  const absl::StatusOr<const TableCatalog::Entry*> source = catalog.Find(options.table());
  if (!source.ok()) return source.status();
  const absl::StatusOr<Coverage> coverage = FromWire(options.coverage());
  if (!coverage.ok()) return coverage.status();
  const absl::StatusOr<std::optional<S44Order>> s44_order = FromWire(options.s44_order());
  if (!s44_order.ok()) return s44_order.status();
  return Query{.source = *source,
               .coverage = *coverage,
               .standard_errors = options.standard_errors(),
               .best_s44_order = options.best_s44_order(),
               .s44_order = *s44_order};
}

PulseAnswer AnswerPulse(const Query& query, const Pulse& pulse) {
  const PulseUncertainty two_sigma = Interpolate(query.source->table, pulse);
  PulseAnswer answer{.uncertainty = WithCoverage(two_sigma, query.coverage), .s44 = {}};
  if (query.asks_s44() && two_sigma.outcome == Outcome::kInterpolated) {
    answer.s44 = AnswerS44(query, WithCoverage(two_sigma, Coverage::kP95), pulse.depth);
  }
  return answer;
}

}  // namespace albtpu::server
