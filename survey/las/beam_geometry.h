// The pulse behind a point: its incidence, azimuth, footprint and depth from the point's height and scan angle.
#pragma once

#include <optional>
#include <span>
#include <variant>

#include "survey/answers/batch.h"

namespace albtpu::client {

// The diameter [m], across its axis, of a beam with full divergence `divergence` [mrad] where it meets the mean
// surface, `altitude` [m] below the aircraft: H / cos(incidence) * divergence. `incidence` is in degrees.
double FootprintDiameter(double altitude, double divergence, double incidence);

// The azimuth [degree], from downwind, of the beam of an across-track scanner. Directions are true, clockwise from
// north: `flight_direction` is where the aircraft flies to, `wind_from` where the wind comes from. The beam points to
// the right of the flight direction at positive scan angles, to the left at negative ones. At nadir the side does not
// matter, because both sides fold to the same azimuth.
double AcrossTrackAzimuth(double flight_direction, double wind_from, double scan_angle);

struct DivergingBeam {
  double altitude = 0;    // m above the water
  double divergence = 0;  // mrad, full angle
};

struct AcrossTrackScan {
  double flight_direction = 0;  // degree, true
  double wind_from = 0;         // degree, true
};

// Everything that the points of a flight line have in common.
struct FlightLine {
  double water_level = 0;                        // In the vertical unit of the file.
  double metres_per_unit = 1;                    // Size of that unit.
  float wind_speed = 0;                          // m/s at 10 m
  std::optional<float> fetch;                    // m; absent: fully developed sea.
  std::variant<float, DivergingBeam> footprint;  // m, or computed for each pulse.
  std::variant<std::monostate, float, AcrossTrackScan>
      azimuth;  // Absent, degree, or computed for each pulse.

  // The pulses of points with heights `z`, in the file's unit, and `scan_angles` [degree]; both spans have the same
  // size. Incidence is |scan angle| and depth is the water level minus z, each rounded once to single precision.
  void MakePulses(std::span<const double> z, std::span<const double> scan_angles, PulseBatch& pulses) const;
};

}  // namespace albtpu::client
