// One segment of a track from rays: the iteration that ray_track.h describes.
#pragma once

#include <cstddef>
#include <numbers>
#include <optional>
#include <span>

#include "budget/beams/refracted_path.h"
#include "budget/beams/return_pair.h"
#include "budget/beams/track_spline.h"

namespace albtpu {

struct RayTrackOptions {
  double longest_gap = 5;                                         // s without a ray; a longer one divides segments.
  double knot_step = 1.5;                                         // s
  std::size_t min_rays = 20;                                      // In a segment.
  double largest_incidence_sigma = 0.3 * std::numbers::pi / 180;  // rad; above it, a position counts as uncertain.
  double min_height = 20,
         max_height = 6000;       // m above the water; outside, the sensor is not on an aircraft.
  double max_speed = 200;         // m/s
  double index = kSeaWaterIndex;  // Of the water, as in RayOfPair.
  RayThinning thinning;
};

// A part of the track without long gaps.
struct RaySegment {
  double start = 0, end = 0;    // Times of the first and last ray.
  std::size_t rays = 0;         // Used, after thinning.
  double water_height = 0;      // m; median of the water points.
  double median_incidence = 0;  // rad
  RayNoise noise;
  double correlation = 1;   // By how much correlated errors multiply the variance of a position.
  double acceleration = 0;  // q, m^2/s^3.
  KnotTimes times{};
  KnotSolution knots;  // States in the frame of the rays; covariances.
};

// The segment that fits `rays`, which are in order of time. None if they are too few, all at one time, or meet nowhere.
std::optional<RaySegment> FitSegment(std::span<const AirRay> rays, const RayTrackOptions& options);

}  // namespace albtpu
