#include "tests/fuzz/twin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tables/query/interpolation.h"
#include "tests/fuzz/fuzz_target.h"

namespace albtpu::fuzz {
namespace {

constexpr double kTolerance = 1e-5;     // Relative; promised by ColumnInterpolator.
constexpr double kCancellation = 1e-6;  // Of the largest magnitude of a quantity: record_blend.h.

double Largest(const std::vector<float>& numbers) {
  double largest = 0;
  for (const float number : numbers) largest = std::max(largest, std::abs(static_cast<double>(number)));
  return largest;
}

void MustBeNear(float ours, float twin, double largest) {
  ALBTPU_MUST(std::isnan(ours) == std::isnan(twin));
  if (std::isnan(twin)) return;
  const double difference = std::abs(static_cast<double>(ours) - twin);
  // Numbers below the smallest normal one have fewer digits.
  constexpr double kFewDigits = std::numeric_limits<float>::min();
  ALBTPU_MUST(difference <= kTolerance * std::abs(twin) + kCancellation * largest + kFewDigits);
}

}  // namespace

Twin::Twin(const UncertaintyTable& table) : table_(table) {
  for (const Quantity quantity : kQuantities) {
    const Variable* variable = table.variable(quantity);
    if (variable == nullptr) continue;
    largest_[Index(quantity)] = Largest(variable->values);
    largest_error_[Index(quantity)] = Largest(variable->standard_errors);
  }
}

void Twin::MustAgree(const Query& query, const PulseColumns& pulses, const AnswerColumns& answers) const {
  for (std::size_t i = 0; i < pulses.size; ++i) {
    const PulseUncertainty twin = WithCoverage(Interpolate(table_, PulseAt(pulses, i)), query.coverage);
    const bool inside = twin.outcome == Outcome::kInterpolated;
    ALBTPU_MUST(answers.outcomes[i] == static_cast<int>(twin.outcome) + 1);
    ALBTPU_MUST(answers.outcome_axes[i] == (twin.axis.has_value() ? Index(*twin.axis) + 1 : 0));
    for (std::size_t q = 0; q < kQuantityCount; ++q) {
      const float* values = answers.values[q];
      const float* errors = answers.standard_errors[q];
      if (values != nullptr) MustBeNear(values[i], twin.values[q], largest_[q]);
      if (errors != nullptr) MustBeNear(errors[i], twin.standard_errors[q], largest_error_[q]);
      if (inside && values != nullptr && table_.variable(kQuantities[q]) != nullptr)
        ALBTPU_MUST(std::isfinite(values[i]));
    }
    if (answers.best_s44_orders != nullptr) ALBTPU_MUST(answers.best_s44_orders[i] <= (inside ? kS44Orders.size() : 0));
    for (const float* remaining : {answers.remaining_thu, answers.remaining_tvu}) {
      if (remaining != nullptr && !inside) ALBTPU_MUST(std::isnan(remaining[i]));
      if (remaining != nullptr && !std::isnan(remaining[i])) ALBTPU_MUST(remaining[i] >= 0);
    }
  }
}

}  // namespace albtpu::fuzz
