// From where a point lies and how the scanner looked at it to the pulse that made it.
#pragma once

#include <optional>
#include <variant>

#include "tables/interpolation.h"

namespace albtpu::client {

// The diameter [m] of a beam of full divergence `divergence` [mrad] at the mean surface, `altitude` [m] below
// the aircraft, across the beam's axis: H / cos(incidence) * divergence.
double FootprintDiameter(double altitude, double divergence, double incidence);

// The azimuth [degree] from downwind of the beam of an across-track scanner. Directions are true, clockwise
// from north: where the aircraft flies to, and where the wind comes from. The beam points to the right of the
// flight at positive scan angles, to the left at negative ones; at nadir either is as good, they fold to one
// azimuth.
double AcrossTrackAzimuth(double flight_direction, double wind_from, double scan_angle);

struct DivergingBeam {
  double altitude = 0;    // m above the water
  double divergence = 0;  // mrad, full angle
};

struct AcrossTrackScan {
  double flight_direction = 0;  // degree, true
  double wind_from = 0;         // degree, true
};

// What all points of a flight line share.
struct FlightLine {
  double water_level = 0;      // In the vertical unit of the file.
  double metres_per_unit = 1;  // Of that unit.
  float wind_speed = 0;
  std::optional<float> fetch;                                    // Absent: fully developed.
  std::variant<float, DivergingBeam> footprint;                  // m, or computed.
  std::variant<std::monostate, float, AcrossTrackScan> azimuth;  // Absent, degree, or computed.

  // Incidence is |scan_angle| [degree], depth the water level minus `z` (in the file's unit), each rounded
  // once to single precision.
  Pulse At(double z, double scan_angle) const;
};

}  // namespace albtpu::client
