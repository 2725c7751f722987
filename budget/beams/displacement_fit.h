// The displacement of a given track that makes it agree with rays, and the mean effect of waves on these rays.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "budget/beams/return_pair.h"

namespace albtpu {

// Positions of a track at `times`, in the frame of the rays; NaN where they are not known. Times may come in any order
// and lie outside of the track.
using TrackPositions = std::function<void(std::span<const double> times, std::span<Eigen::Vector3d> positions)>;

// A ray, and the position and velocity of the sensor at its time by the given track.
struct TrackedRay {
  AirRay ray;
  Eigen::Vector3d position, velocity;
};

// The rays for which the track has a position and a velocity at their time plus `shift`, in order.
std::vector<TrackedRay> FollowTrack(std::span<const AirRay> rays, const TrackPositions& track, double shift);

// The displacement of a given track that makes it agree with rays: Gauss-Newton on the same angles, noise and weights
// as the fit of a track (ray_track.h), with a few parameters for all rays together.

// Forward and right are horizontal, along and across the course of the track.
enum class Displacement {
  kOffset,          // Forward, right, up [m].
  kOffsetRotation,  // The same, and a rotation about the vertical through the mean position [rad], to the left.
  kTime,            // Along the velocity [s].
};

struct DisplacementFit {
  Eigen::VectorXd values, sigmas;  // With errors that are correlated for up to half a second,
  int freedom = 1;                 // so that the sigmas have the degrees of freedom of so many correlation times.
  RayNoise noise;                  // Of the rays about the displaced track.
  double flattening = 0;           // Mean angle by waves per sine of the incidence (FacingSlopesAt).
  double median_angle = 0;         // rad; median angle between rays and directions from the displaced track.
};

// Requires at least one ray more than there are parameters. `index` is that of the water.
DisplacementFit FitDisplacement(std::span<const TrackedRay> rays, Displacement displacement, double index);

// The displacement of one ray's position by `values`, about the mean position `centre`.
Eigen::Vector3d DisplacementOf(const TrackedRay& ray, Displacement displacement, const Eigen::VectorXd& values,
                               const Eigen::Vector3d& centre);

// The median angle between rays and the directions from the track to their water points.
double MedianAngle(std::span<const TrackedRay> rays);

// A mean and its standard error, where values up to half a second apart are correlated, and the degrees of freedom of
// that error. Each value has a weight.
struct MeanOverTime {
  double mean, sigma;
  int freedom;
};
MeanOverTime WeightedMean(std::span<const double> times, std::span<const double> values,
                          std::span<const double> weights);

// The effect of waves on the mean of the beam directions that are derived from pairs of returns.
//
// Two effects do not average out over waves whose slopes m have the variance s^2 along each axis. A beam meets a facet
// with a probability proportional to the facet's area across the beam, 1 + m . t, t the horizontal vector of length
// tan(incidence): facets that face the beam are met more often. And refraction is not linear in the slope. To second
// order the mean of a function f(m) over the facets that are met is
//     f(0) + s^2 (t . grad f + (f_xx + f_yy) / 2).
// f is the angle in the plane of incidence between the ray of a pair (return_pair.h) and the true beam. Its mean is
// positive: rays seem flatter than they are, and a sensor where they meet would lie too low, by 0.15 % of its height at
// slopes of 0.07.

struct FacingSlopes {
  double gain;  // Root mean square, over both components, of the angle of the ray per slope.
  double bias;  // Mean angle in the plane of incidence, rad, per s^2; positive away from nadir.
};

// For beams at `incidence` [rad], less than 1.2, into water of index `index`.
FacingSlopes FacingSlopesAt(double incidence, double index);

// The angle [rad] from the direction `v` to the ray's direction `u`, as a vector across v, less the mean that waves
// cause: `flattening` times the sine of the incidence of v, outward.
inline Eigen::Vector3d AngleBetween(const Eigen::Vector3d& v, const Eigen::Vector3d& u, double flattening) {
  const double cosine = u.dot(v);
  const Eigen::Vector3d across = u - cosine * v;
  const double sine = across.norm();
  const Eigen::Vector3d outward(-v.z() * v.x(), -v.z() * v.y(), 1 - v.z() * v.z());
  return across * (sine < 1e-12 ? 1 : std::atan2(sine, cosine) / sine) - flattening * outward;
}

}  // namespace albtpu
