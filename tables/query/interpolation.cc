#include "tables/query/interpolation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tables/coverage.h"
#include "tables/query/table_interpolation.h"

namespace albtpu {
namespace {

using Coordinates = std::array<double, kAxisCount>;

PulseUncertainty InterpolatePulse(const UncertaintyTable& table, const Coordinates& coordinates) {
  const TableValues answer = InterpolateAt(table.table(), coordinates);
  PulseUncertainty uncertainty;
  uncertainty.outcome = answer.outcome;
  if (answer.axis.has_value()) uncertainty.axis = kAxes[*answer.axis];
  std::copy_n(answer.values.begin(), kQuantityCount, uncertainty.values.begin());
  std::copy_n(answer.standard_errors.begin(), kQuantityCount, uncertainty.standard_errors.begin());
  if (answer.outcome == Outcome::kInterpolated)
    uncertainty.radius_over_thu = RadiusOverThu(uncertainty.values);
  return uncertainty;
}

// The outcome that counts for both: invalid before out of domain, then the first axis.
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
    return InterpolatePulse(table, coordinates);
  };
  if (pulse.azimuth.has_value()) return at_azimuth(*pulse.azimuth);
  return LargerOf(at_azimuth(kFoldedEnds[0]), at_azimuth(kFoldedEnds[1]));
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
