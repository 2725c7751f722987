// From where a point lies and how the scanner looked at it to the pulse that made it.
#pragma once

#include <optional>
#include <span>
#include <variant>

#include "survey/answers/batch.h"

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

  // The pulses of points at heights `z` (in the file's unit) that were seen at `scan_angles` [degree], as
  // many. Incidence is |scan angle|, depth the water level minus z, each rounded once to single precision.
  void MakePulses(std::span<const double> z, std::span<const double> scan_angles, PulseBatch& pulses) const;
};

}  // namespace albtpu::client
