// How answers are to be given; the flags that all commands share.
#pragma once

#include <optional>

#include "tables/coverage.h"
#include "tables/query/column_query.h"
#include "tables/s44.h"

namespace albtpu::client {

struct AnswerStyle {
  Coverage coverage = Coverage::kTwoSigma;
  std::optional<S44Order> s44_order;  // Adds what this order leaves.
  bool standard_errors = false;       // Adds the standard errors.

  Query query() const { return {.coverage = coverage, .s44_order = s44_order}; }
};

// "2 sigma" or "95 %".
constexpr const char* CoverageText(Coverage coverage) {
  return coverage == Coverage::kTwoSigma ? "2 sigma" : "95 %";
}

}  // namespace albtpu::client
