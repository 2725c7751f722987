// What may be wrong on the way from the aircraft to a reported point, before the sea and the water: standard
// deviations, and how the water surface was located.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace albtpu {

// One standard deviation each; 0 is an error that does not occur. Errors of different sources are independent.
struct AirErrors {
  std::array<double, 3> position = {};  // m; of the trajectory, north, east, down.
  std::array<double, 3> attitude = {};  // degree; of the trajectory, roll, pitch, heading.
  std::array<double, 3> boresight =
      {};                     // degree; rotations about the forward, right and down axes of the aircraft.
  double lever_arm = 0;       // m; of each axis.
  double scan = 0;            // degree; of each of two angles across the beam, pulse by pulse.
  double time = 0;            // s; of the laser's clock against the trajectory's, constant.
  double range_offset = 0;    // m; constant, of all ranges.
  double bottom_range = 0;    // m; optical, of the range to the bottom, pulse by pulse.
  double surface_range = 0;   // m; of the range to the surface, where the pulse's own return located it.
  double surface_height = 0;  // m; of the height at which the surface was located.
  double index = 0;           // of the refractive index of the water.
};

// How the processing of the survey found where each beam entered the water.
enum class SurfaceLocation : std::uint8_t {
  kPulse,  // By the pulse's own return from the surface.
  kLocal,  // By a model of the surface, made of the survey's own returns from it. Moves with the trajectory.
  kLevel,  // By a water level, whose height is known apart from the trajectory.
};
inline constexpr std::array<std::string_view, 3> kSurfaceLocationNames = {"pulse", "local", "level"};

// What errors average out over. A mean over many pulses keeps the errors of line and survey, a mean over many lines
// those of the survey.
enum class ErrorGroup : std::uint8_t {
  kPulse,   // Drawn anew for each pulse: scan angle, range, sea surface.
  kLine,    // Common to neighbouring pulses of a line: position and attitude of the trajectory.
  kSurvey,  // Common to all: boresight, lever arm, time, range offset, index, water level, datum.
};
inline constexpr std::size_t kErrorGroups = 3;
inline constexpr std::array<std::string_view, kErrorGroups> kErrorGroupNames = {"pulse", "line", "survey"};

// The group of the height of the surface: of the own return that of the pulse, of a model that of the line, because
// neighbouring pulses share it, of a level that of the survey.
constexpr ErrorGroup SurfaceHeightGroup(SurfaceLocation located) { return static_cast<ErrorGroup>(located); }

}  // namespace albtpu
