#include "service/client/beam_geometry.h"

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

Pulse FlightLine::At(double z, double scan_angle) const {
  Pulse pulse;
  pulse.wind_speed = wind_speed;
  if (fetch.has_value()) pulse.fetch = *fetch;
  pulse.incidence = static_cast<float>(std::abs(scan_angle));
  pulse.depth = static_cast<float>((water_level - z) * metres_per_unit);
  if (const auto* given = std::get_if<float>(&footprint)) {
    pulse.footprint = *given;
  } else {
    const auto& beam = std::get<DivergingBeam>(footprint);
    pulse.footprint =
        static_cast<float>(FootprintDiameter(beam.altitude, beam.divergence, std::abs(scan_angle)));
  }
  if (const auto* given = std::get_if<float>(&azimuth)) {
    pulse.azimuth = *given;
  } else if (const auto* scan = std::get_if<AcrossTrackScan>(&azimuth)) {
    pulse.azimuth =
        static_cast<float>(AcrossTrackAzimuth(scan->flight_direction, scan->wind_from, scan_angle));
  }
  return pulse;
}

}  // namespace albtpu::client
