// What a query asks of each of its pulses, and the answer for one. Rows and columns both come from here, so
// that they agree bit by bit.
#pragma once

#include <optional>

#include "absl/status/statusor.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/server/table_catalog.h"
#include "tables/coverage.h"
#include "tables/interpolation.h"
#include "tables/s44.h"

namespace albtpu::server {

// `QueryOptions`, read.
struct Query {
  const TableCatalog::Entry* source = nullptr;
  Coverage coverage = Coverage::kTwoSigma;
  bool standard_errors = false;
  bool best_s44_order = false;
  std::optional<S44Order> s44_order;

  bool asks_s44() const { return best_s44_order || s44_order.has_value(); }
};

// Fails as `QueryOptions` documents. The result refers to `catalog`.
absl::StatusOr<Query> ReadOptions(const v1::QueryOptions& options, const TableCatalog& catalog);

struct S44Answer {
  std::optional<S44Order> best_order;
  std::optional<float> remaining_thu;  // m at 95 %
  std::optional<float> remaining_tvu;  // m at 95 %
};

struct PulseAnswer {
  PulseUncertainty uncertainty;  // At the coverage of the query.
  S44Answer s44;                 // Empty where nothing was asked or there is no number.
};

PulseAnswer AnswerPulse(const Query& query, const Pulse& pulse);

}  // namespace albtpu::server
