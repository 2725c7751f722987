// The columns of an answer: which there are, in which order, and what stands in them. CSV files and `pulse
// --json` have the same.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tables/coverage.h"
#include "tables/interpolation.h"
#include "tables/s44.h"

namespace albtpu::client {

// How answers are to be given; the flags that all commands share.
struct AnswerStyle {
  Coverage coverage = Coverage::kTwoSigma;
  std::optional<S44Order> s44_order;  // Adds the columns of S-44.
  bool standard_errors = false;       // Adds the standard errors.
};

// A number, a text, or nothing.
using AnswerCell = std::variant<std::monostate, float, std::string>;

// Columns, in order:
//   refraction_along_wind, refraction_cross_wind  degree
//   thu, tvu, bias_along_beam, bias_vertical      m
//   outcome                                       as OutcomeText says
//   with standard errors:  <each of the six>_standard_error, in its unit
//   with an S-44 order:
//     s44_best_order                              the strictest order that the surface alone leaves open;
//                                                 nothing if none
//     s44_remaining_thu, s44_remaining_tvu        m at 95 %, what the order's limit leaves for all other
//                                                 sources; nothing if the surface alone exceeds it
class AnswerColumns {
 public:
  explicit AnswerColumns(AnswerStyle style);

  const std::vector<std::string>& names() const { return names_; }

  // One cell a column. `two_sigma` is as a table or a server gives it.
  std::vector<AnswerCell> Cells(const Pulse& pulse, const PulseUncertainty& two_sigma) const;

 private:
  AnswerStyle style_;
  std::vector<std::string> names_;
};

}  // namespace albtpu::client
