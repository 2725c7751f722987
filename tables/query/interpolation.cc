#include "tables/query/interpolation.h"

#include <cmath>

#include "tables/coverage.h"

namespace albtpu {
namespace {

using Coordinates = std::array<double, kAxisCount>;
using Brackets = std::array<Bracket, kAxisCount>;

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

PulseUncertainty WithoutNumbers(Outcome outcome, std::optional<AxisId> axis) {
  PulseUncertainty uncertainty;
  uncertainty.outcome = outcome;
  uncertainty.axis = axis;
  uncertainty.values.fill(kNoNumber);
  uncertainty.standard_errors.fill(kNoNumber);
  return uncertainty;
}

bool IsValid(AxisId axis, double coordinate) {
  return std::isfinite(coordinate) || (axis == AxisId::kFetch && coordinate > 0);
}

// The nodes around a pulse that have weight, as an index into a variable and a weight; the weights add up
// to 1. A pulse on a node sees that node alone, so that it gets exactly what the table holds there.
class Corners {
 public:
  // Over the first `axis_count` axes of the table.
  Corners(const UncertaintyTable& table, const Brackets& brackets, std::size_t axis_count) {
    corners_[0] = {0, 1.0};
    for (std::size_t axis = 0; axis < axis_count; ++axis) Split(brackets[axis], table.axes()[axis].size());
  }

  // The weighted mean of `f` over the corners' values.
  template <typename Function>
  double Mean(const std::vector<float>& values, Function f) const {
    double mean = 0;
    for (std::size_t i = 0; i < count_; ++i) mean += corners_[i].weight * f(values[corners_[i].index]);
    return mean;
  }

  double Mean(const std::vector<float>& values) const {
    return Mean(values, [](double value) { return value; });
  }

 private:
  struct Corner {
    std::size_t index;
    double weight;
  };

  void Split(const Bracket& bracket, std::size_t node_count) {
    const std::size_t before = count_;
    for (std::size_t i = 0; i < before; ++i) {
      Corner& corner = corners_[i];
      const std::size_t lower = corner.index * node_count + bracket.lower;
      const double weight = corner.weight;
      if (bracket.fraction == 1) {
        corner = {lower + 1, weight};
        continue;
      }
      corner = {lower, weight * (1 - bracket.fraction)};
      if (bracket.fraction > 0) corners_[count_++] = {lower + 1, weight * bracket.fraction};
    }
  }

  std::array<Corner, std::size_t{1} << kAxisCount> corners_;
  std::size_t count_ = 1;
};

double InterpolateValue(const Variable& variable, const Corners& corners) {
  if (variable.scale == Scale::kLinear) return corners.Mean(variable.values);
  return std::exp(corners.Mean(variable.values, [](double value) { return std::log(value); }));
}

PulseUncertainty InterpolateAt(const UncertaintyTable& table, const Coordinates& coordinates) {
  for (AxisId axis : kAxes) {
    if (!IsValid(axis, coordinates[Index(axis)])) return WithoutNumbers(Outcome::kInvalid, axis);
  }
  Brackets brackets;
  for (AxisId axis : kAxes) {
    const std::optional<Bracket> bracket = table.axis(axis).Locate(coordinates[Index(axis)]);
    if (!bracket.has_value()) return WithoutNumbers(Outcome::kOutOfDomain, axis);
    brackets[Index(axis)] = *bracket;
  }

  const Corners without_depth(table, brackets, Index(AxisId::kDepth));
  const Corners with_depth(table, brackets, kAxisCount);
  PulseUncertainty uncertainty = WithoutNumbers(Outcome::kInterpolated, std::nullopt);
  for (Quantity quantity : kQuantities) {
    const Variable* variable = table.variable(quantity);
    if (variable == nullptr) continue;
    const Corners& corners = Describe(quantity).over_depth ? with_depth : without_depth;
    uncertainty.values[Index(quantity)] = static_cast<float>(InterpolateValue(*variable, corners));
    if (variable->standard_errors.empty()) continue;
    uncertainty.standard_errors[Index(quantity)] =
        static_cast<float>(corners.Mean(variable->standard_errors));
  }
  uncertainty.radius_over_thu = RadiusOverThu(uncertainty.values);
  return uncertainty;
}

// The outcome that stands for both: invalid before out of domain, then the first axis.
const PulseUncertainty& WorseOutcome(const PulseUncertainty& a, const PulseUncertainty& b) {
  if (a.outcome != b.outcome) return a.outcome > b.outcome ? a : b;
  return a.axis <= b.axis ? a : b;
}

}  // namespace

PulseUncertainty Interpolate(const UncertaintyTable& table, const Pulse& pulse) {
  Coordinates coordinates;
  coordinates[Index(AxisId::kWindSpeed)] = pulse.wind_speed;
  coordinates[Index(AxisId::kFetch)] = pulse.fetch;
  coordinates[Index(AxisId::kIncidence)] = pulse.incidence;
  coordinates[Index(AxisId::kFootprint)] = pulse.footprint;
  coordinates[Index(AxisId::kDepth)] = pulse.depth;
  const auto at_azimuth = [&](double azimuth) {
    coordinates[Index(AxisId::kAzimuth)] = azimuth;
    return InterpolateAt(table, coordinates);
  };
  if (pulse.azimuth.has_value()) return at_azimuth(*pulse.azimuth);
  return LargerOf(at_azimuth(0), at_azimuth(90));
}

PulseUncertainty LargerOf(const PulseUncertainty& downwind, const PulseUncertainty& crosswind) {
  const bool numbers =
      downwind.outcome == Outcome::kInterpolated && crosswind.outcome == Outcome::kInterpolated;
  PulseUncertainty larger = numbers ? downwind : WorseOutcome(downwind, crosswind);
  larger.azimuth_absent = true;
  if (!numbers) return larger;
  for (std::size_t i = 0; i < kQuantityCount; ++i) {
    if (!(std::abs(crosswind.values[i]) > std::abs(downwind.values[i]))) continue;
    larger.values[i] = crosswind.values[i];
    larger.standard_errors[i] = crosswind.standard_errors[i];
  }
  larger.radius_over_thu = LargerRadiusOverThu(downwind[Quantity::kThu], downwind.radius_over_thu,
                                               crosswind[Quantity::kThu], crosswind.radius_over_thu);
  return larger;
}

}  // namespace albtpu
