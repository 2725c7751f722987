// A node of the surface from the points of its cell, and its uncertainty.
//
// With weights 1 / N, and the vertical error of a point at a fixed place, g^T e with g = (-dz/dx, -dz/dy, 1),
//     var(node) = sum over passes of (n / N)^2 R_n S  +  sum over points of P / N^2
//               + sum over lines of (n / N)^2 L  +  U:
// S the sea, P what is drawn anew for each pulse, L what a line shares, U what the survey shares. R_n is what n pulses
// at their places keep of the sea's share of one (pulse_pairs.h): R + (1 - R) / n at random places. A pass is what
// one line sees of the cell at once: the fore and the aft part of a scan see other waves. Dry points have no S. Bias is
// not averaged away, and stays apart. docs/surface.md derives this.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "quality/seas/sea_of_pulses.h"
#include "quality/surface/surface_point.h"

namespace albtpu::quality {

// Of the horizontal variance of points without the sea's share: the fractions of the groups, which add up to 1.
struct HorizontalGroups {
  double pulse = 1, line = 0, survey = 0;
};

// What a node needs to know of the sources of its points, by SurfacePoint::source.
struct NodeSources {
  // `incidence` and `azimuth` in degree, `footprint` in m; `places` of the pulses to the east and north of one, m.
  std::function<SeaOfPulses(std::uint16_t source, double incidence, double azimuth, double footprint,
                            std::span<const Eigen::Vector2d> places)>
      sea;
  std::function<HorizontalGroups(std::uint16_t source)> groups;
  double metres_per_unit = 1;  // Of the map.
};

// Waves are other ones after this time: at 6 m/s and a footprint of 0.6 m the correlation of slopes is 0.92 after 0.1 s
// and below 0 after 0.5 s. The fore and the aft part of a scan are seconds apart.
inline constexpr double kPassPause = 0.5;  // s

// Variances at 1 sigma, m^2.
struct NodeVariance {
  double pulse = 0, sea = 0, line = 0, survey = 0;
  int passes = 0;
  double of_point = 0;  // Of one point, without what the survey shares: the mean.
  double of_plane = 0;  // What the error of the plane's slope adds to `pulse`, or takes away.

  double apart_from_survey() const { return pulse + sea + line; }
  double total() const { return apart_from_survey() + survey; }
  // Of the heights of `points` points about their mean: what the sample variance estimates.
  double within_cell(std::size_t points) const;
};

// What one line shares of the error of a node.
struct LineOfNode {
  std::uint16_t flight_line = 0;
  double time = 0;   // s, of its first point here.
  double sigma = 0;  // m
};

// Of the mean of `points`, one at least, which are in the order of SurfacePoint::Order. `slope` is that of the bottom,
// m per m. What lines share, whose squares add up to `line`, is put
// into `lines`, if given.
NodeVariance VarianceOf(std::span<const SurfacePoint> points, const Eigen::Vector2d& slope, const NodeSources& sources,
                        std::vector<LineOfNode>* lines = nullptr);

// One node, in the middle of its cell. Variances at 1 sigma, m^2.
struct SurfaceNode {
  std::uint32_t points = 0;                                     // That its height is made of; 0: no node.
  std::uint32_t left_out = 0;                                   // Beyond kFarthest standard deviations.
  std::uint32_t dry = 0;                                        // Of `points`, those that are dry.
  double elevation = std::numeric_limits<double>::quiet_NaN();  // m, upwards, in the datum of the points
  NodeVariance variance;
  double bias = 0;                                                   // m, of the elevation: the mean of its points
  double deviation = std::numeric_limits<double>::quiet_NaN();       // m, of the points from the plane; of one: NaN
  double shoalest = std::numeric_limits<double>::quiet_NaN();        // m: the highest of the points, upwards
  double shoalest_sigma = std::numeric_limits<double>::quiet_NaN();  // m, of its height
  float depth = 0;                                                   // m, of the water: the mean of points under it
  float thu = 0;                                                     // m, 95 %: the mean of the points
  float slope_x = 0, slope_y = 0;                                    // m per m
};

inline constexpr double kFarthest = 6;

}  // namespace albtpu::quality
