#include "tables/query/interpolation.h"

#include <algorithm>
#include <array>
#include <span>

#include "tables/coverage.h"
#include "tables/query/larger_answer.h"
#include "tables/query/table_interpolation.h"

namespace albtpu {
namespace {

using Coordinates = std::array<double, kAxisCount>;

PulseUncertainty InterpolatePulse(const UncertaintyTable& table, const Coordinates& coordinates) {
  const TableValues answer = InterpolateAt(table.table(), coordinates);
  PulseUncertainty uncertainty;
  uncertainty.outcome = answer.outcome;
  if (answer.axis.has_value()) uncertainty.axis = kAxes[*answer.axis];
  uncertainty.side = answer.side;
  std::copy_n(answer.values.begin(), kQuantityCount, uncertainty.values.begin());
  std::copy_n(answer.standard_errors.begin(), kQuantityCount, uncertainty.standard_errors.begin());
  if (answer.outcome == Outcome::kInterpolated)
    uncertainty.radius_over_thu = RadiusOverThu(uncertainty.values);
  return uncertainty;
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
  PulseUncertainty larger = LargerAnswer(a, b);
  larger.azimuth_absent = true;
  if (larger.outcome != Outcome::kInterpolated) return larger;
  larger.radius_over_thu =
      LargerRadiusOverThu(a[Quantity::kThu], a.radius_over_thu, b[Quantity::kThu], b.radius_over_thu);
  return larger;
}

}  // namespace albtpu
