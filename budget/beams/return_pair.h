// Rays in air from pairs of returns of one pulse: their derivation, the model of their errors, where several of them
// meet, and the choice of the most informative ones.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "budget/beams/track_spline.h"

namespace albtpu {

// A model of the errors of ray directions, estimated from their residuals to a track.

// The angle between a ray and the line from the sensor to its water point has two components, of which each has the
// variance, in rad^2,
//     sigma^2 = slopes^2 + (points / separation)^2
// for a good ray: the slopes of the water turn all rays alike, the errors of the returns (`points` in m) turn those of
// long separation less. A fraction of the rays (mixed returns, vegetation) has the variance `outlier_sigma`^2 instead.
struct RayNoise {
  double slopes = 0.02, points = 0.05;
  double outlier_share = 0.1, outlier_sigma = 0.3;

  double Variance(double separation) const {
    const double p = points / separation;
    return slopes * slopes + p * p;
  }
};

// The weight of a ray whose squared residual is `square` [rad^2], in 1/rad^2: 1/sigma^2 times the probability that it
// is good, and 1/outlier_sigma^2 times the rest; -weight times the residual is the gradient of the log-likelihood.
// `response` is minus half of the divergence of that gradient: what the weight contributes to the curvature of the
// likelihood, less than `weight` between good and outlying residuals.
struct RayWeight {
  double good = 0;  // The probability.
  double weight = 0, response = 0;
};
RayWeight WeightOf(const RayNoise& noise, double separation, double square);

// Fits the noise to residuals by expectation-maximization: `steps` steps, beginning with `start`. `squares` are the
// squared residuals |r|^2 of both components together [rad^2].
RayNoise FitRayNoise(std::span<const double> squares, std::span<const double> separations, const RayNoise& start,
                     int steps);

// A start for FitRayNoise from medians, which 30 % of outliers do not spoil.
RayNoise RobustRayNoise(std::span<const double> squares, std::span<const double> separations);

// Two returns of one pulse, both from below the water, and the ray in air that follows from them.
//
// Derivation. The returns of a pulse lie on its straight path in water, so their difference has the direction w of the
// beam there. Snell's law keeps the horizontal part of n times the direction at a level surface: u_h = n w_h, and the
// direction u in air, downward and of length 1, follows. The path meets the water where the line through the returns
// does, S = P + w (h - P_z) / w_z. The line is the best one through two returns of equal error: it passes through both,
// so S is the same from either of them. All of this is exact for still water.
//
// Errors. Errors of `sigma` [m] of each return across the path turn w by sqrt(2) sigma / separation, and u by about n
// times that. A slope m of the water turns w by g m, with g = 1 - cos(theta) / (n cos(theta_r)), about 1/4, whatever
// the separation.

// Positions in a local frame in metres: x grid east, y grid north, z up in the vertical datum of the points.
struct ReturnPair {
  double time = 0;               // GPS time as the points state it.
  Eigen::Vector3d upper, lower;  // The return nearer to the surface, and the deeper one.
  bool upper_is_bottom = false;  // By its class; otherwise it may be a return from a wave.
};

// The straight line of a beam in air.
struct AirRay {
  double time = 0;
  Eigen::Vector3d water_point;  // The point where it met the water.
  Eigen::Vector3d direction;    // Unit vector from the sensor down to the water.
  double separation = 0;        // m between the two returns; the longer, the better the direction is known.
};

// The ray of a pair over water at height `water_height`, of index `index`. None if a return lies above the water, if
// the two are nearer than `min_separation` [m] or the lower one is not below the upper one, if no ray in air refracts
// into their direction, or if a number is not finite.
std::optional<AirRay> RayOfPair(const ReturnPair& pair, double water_height, double index, double min_separation = 1);

// The point at which the rays of a few seconds meet, without a start value.

// The position at `time` and the velocity of a sensor in straight motion that is nearest to the lines of `rays`: the
// solution of
//     sum of w Q (X0 + V (t - time) - S) = 0,    Q = I - u u',
// 6 linear equations, solved again eight times with w = 1 / (1 + (e / s)^2), e the distances from the lines and s their
// median. None when the rays do not determine it. It puts the sensor too low where directions have errors: a lower one
// is nearer to lines that scatter by angles. It is a start for angles.
std::optional<KnotState> WhereRaysMeet(std::span<const AirRay> rays, double time);

// Thins the rays of a long recording: keeps the most informative ones, at most a given number.

struct RayThinning {
  double bin = 0.005;              // s; shorter than a revolution of a scanner, so that all azimuths stay.
  std::size_t rays_per_bin = 20;   // At most 4000 rays a second.
  std::size_t max_rays = 2000000;  // Of all bins together; beyond it, `rays_per_bin` falls, down to 1.
};

// The rays in order of time, those that are not finite left out, at most `rays_per_bin` in each `bin` of time. The ones
// of long separation stay, by classes a factor of sqrt(2) wide; within a class a hash of the time decides. Choosing
// the very longest would favour errors that lengthen a pair, and so bias its direction where all are about equal.
std::vector<AirRay> ThinRays(std::span<const AirRay> rays, const RayThinning& thinning);

}  // namespace albtpu
