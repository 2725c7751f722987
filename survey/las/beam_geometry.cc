#include "survey/las/beam_geometry.h"

#include <cmath>
#include <numbers>

namespace albtpu::client {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;
constexpr double kRadiansPerMilliradian = 1e-3;

}  // namespace

double FootprintDiameter(double altitude, double divergence, double incidence) {
  return altitude / std::cos(incidence * kRadiansPerDegree) * (divergence * kRadiansPerMilliradian);
}

double AcrossTrackAzimuth(double flight_direction, double wind_from, double scan_angle) {
  const double beam = scan_angle < 0 ? flight_direction - 90 : flight_direction + 90;
  const double downwind = wind_from + 180;
  return beam - downwind;
}

void FlightLine::MakePulses(std::span<const double> z, std::span<const double> scan_angles,
                            PulseBatch& pulses) const {
  const auto column_of = [](std::span<const double> values, auto convert, std::vector<float>& column) {
    column.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) column[i] = static_cast<float>(convert(values[i]));
  };
  pulses.size = z.size();
  pulses[AxisId::kWindSpeed].assign(1, wind_speed);
  pulses[AxisId::kFetch].assign(fetch.has_value() ? 1 : 0, fetch.value_or(0));
  column_of(
      scan_angles, [](double angle) { return std::abs(angle); }, pulses[AxisId::kIncidence]);
  column_of(
      z, [this](double height) { return (water_level - height) * metres_per_unit; }, pulses[AxisId::kDepth]);
  if (const auto* given = std::get_if<float>(&footprint)) {
    pulses[AxisId::kFootprint].assign(1, *given);
  } else {
    const DivergingBeam beam = std::get<DivergingBeam>(footprint);
    column_of(
        scan_angles,
        [beam](double angle) { return FootprintDiameter(beam.altitude, beam.divergence, std::abs(angle)); },
        pulses[AxisId::kFootprint]);
  }
  pulses[AxisId::kAzimuth].clear();
  if (const auto* given = std::get_if<float>(&azimuth)) {
    pulses[AxisId::kAzimuth].assign(1, *given);
  } else if (const auto* scan = std::get_if<AcrossTrackScan>(&azimuth)) {
    column_of(
        scan_angles,
        [scan](double angle) { return AcrossTrackAzimuth(scan->flight_direction, scan->wind_from, angle); },
        pulses[AxisId::kAzimuth]);
  }
}

}  // namespace albtpu::client
