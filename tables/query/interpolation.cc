#include "tables/query/interpolation.h"

#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "tables/coverage.h"

namespace albtpu {
namespace {

using Brackets = std::array<Bracket, kAxisCount>;
using Coordinates = std::array<double, kAxisCount>;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

PulseUncertainty WithoutNumbers(Outcome outcome, std::optional<AxisId> axis) {
  PulseUncertainty uncertainty;
  uncertainty.outcome = outcome;
  uncertainty.axis = axis;
  uncertainty.values.fill(kNan);
  uncertainty.standard_errors.fill(kNan);
  return uncertainty;
}

bool IsValid(const AxisSchema& axis, double coordinate) {
  return std::isfinite(coordinate) || (axis.is_endless && coordinate > 0);
}

// The nodes around a pulse that have weight, each as an index into a variable and a weight; the weights add up to
// 1. For a pulse on a node there is that node alone, so that the answer is exactly the value in the table.
class Corners {
 public:
  // Over the first `axis_count` axes of the table.
  Corners(const UncertaintyTable& table, const Brackets& brackets, std::size_t axis_count) {
    corners_[0] = {0, 1.0};
    for (std::size_t axis = 0; axis < axis_count; ++axis) Split(brackets[axis], table.axes()[axis].size());
  }

  // The weighted mean of `f` over the values at the corners.
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

PulseUncertainty InterpolatePulse(const UncertaintyTable& table, const Coordinates& coordinates) {
  for (const AxisId id : kAxes)
    if (!IsValid(table.axis(id).schema(), coordinates[Index(id)])) return WithoutNumbers(Outcome::kInvalid, id);
  Brackets brackets;
  for (const AxisId id : kAxes) {
    const Axis& axis = table.axis(id);
    const std::optional<Bracket> bracket = axis.Locate(coordinates[Index(id)]);
    if (!bracket.has_value()) {
      PulseUncertainty outside = WithoutNumbers(Outcome::kOutOfDomain, id);
      outside.side = SideOf(axis.schema(), axis.nodes().back(), coordinates[Index(id)]);
      return outside;
    }
    brackets[Index(id)] = *bracket;
  }

  const Corners without_depth(table, brackets, kAxisCount - 1);
  const Corners with_depth(table, brackets, kAxisCount);
  PulseUncertainty answer = WithoutNumbers(Outcome::kInterpolated, std::nullopt);
  for (const Quantity quantity : kQuantities) {
    const Variable* variable = table.variable(quantity);
    if (variable == nullptr) continue;
    const Corners& corners = Describe(quantity).over_last_axis ? with_depth : without_depth;
    answer.values[Index(quantity)] = static_cast<float>(InterpolateValue(*variable, corners));
    if (variable->standard_errors.empty()) continue;
    answer.standard_errors[Index(quantity)] = static_cast<float>(corners.Mean(variable->standard_errors));
  }
  answer.radius_over_thu = RadiusOverThu(answer.values);
  return answer;
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
    return InterpolatePulse(table, coordinates);
  };
  if (pulse.azimuth.has_value()) return at_azimuth(*pulse.azimuth);
  const std::span<const double> azimuths = table.axis(AxisId::kAzimuth).alternatives();
  PulseUncertainty largest = at_azimuth(azimuths.front());
  largest.azimuth_absent = true;
  for (const double azimuth : azimuths.subspan(1)) largest = LargerOf(largest, at_azimuth(azimuth));
  return largest;
}

PulseUncertainty LargerOf(const PulseUncertainty& a, const PulseUncertainty& b) {
  PulseUncertainty larger = a;
  if (a.outcome != b.outcome) {
    larger = a.outcome > b.outcome ? a : b;
  } else if (a.outcome != Outcome::kInterpolated) {
    larger = a.axis <= b.axis ? a : b;
  } else {
    for (std::size_t q = 0; q < kQuantityCount; ++q) {
      if (!(std::abs(b.values[q]) > std::abs(a.values[q]))) continue;
      larger.values[q] = b.values[q];
      larger.standard_errors[q] = b.standard_errors[q];
    }
    larger.radius_over_thu =
        LargerRadiusOverThu(a[Quantity::kThu], a.radius_over_thu, b[Quantity::kThu], b.radius_over_thu);
  }
  larger.azimuth_absent = true;
  return larger;
}

}  // namespace albtpu
