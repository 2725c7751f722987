// A point of the bottom, as a node of the surface takes it.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace albtpu::quality {

// Variances at 1 sigma, m^2. The sea's share is apart from the three groups of other errors.
struct SurfacePoint {
  double x = 0, y = 0;  // In the units of the map.
  double z = 0;         // m
  double time = 0;      // GPS time, s; 0 if its points have none.

  // Of the height: what is drawn anew for each pulse, what a line shares, what the survey shares.
  float pulse = 0, line = 0, survey = 0;
  float sea = 0;
  // Of the whole error, on the axes of the map, with z up: its other entries.
  float xx = 0, yy = 0, xy = 0, xz = 0, yz = 0;

  float incidence = 0, azimuth = 0;     // degree; the azimuth clockwise from north, where the beam travels to.
  float footprint = 0;                  // m
  float depth = 0;                      // m, below the water; NaN of a dry point, over which no water lay
  float bias = 0, bias_along_beam = 0;  // m, of the height, and towards the azimuth

  std::uint16_t flight_line = 0;  // Point source ID. After a pause, another line of the same ID begins.
  std::uint16_t source = 0;       // Of NodeSources.

  bool dry() const { return std::isnan(depth); }

  // Points in one order, whatever the order of their files: first lines, then times.
  auto Order() const { return std::tuple(flight_line, time, x, y, z, source, incidence, pulse); }
};
static_assert(sizeof(SurfacePoint) == 96);

}  // namespace albtpu::quality
