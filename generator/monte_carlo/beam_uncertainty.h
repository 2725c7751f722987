// From the errors of a beam in many realizations of the sea to its uncertainty.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "generator/math/statistics.h"
#include "generator/monte_carlo/slope_moments.h"
#include "generator/surface/beam.h"
#include "generator/surface/ray_tracer.h"

namespace albtpu {

// The position that is reported for a beam through one surface, minus the true one. Errors are linear in the depth d.
struct BeamErrors {
  Eigen::Vector2d tangent = Eigen::Vector2d::Zero();  // t - t_still
  // The horizontal error of the spot is offset [m] + d per_depth.
  Eigen::Vector2d horizontal_offset = Eigen::Vector2d::Zero();
  Eigen::Vector2d horizontal_per_depth = Eigen::Vector2d::Zero();
  double vertical_offset = 0;  // m, likewise of the elevation
  double vertical_per_depth = 0;
};

// In still water the spot would lie t_still d from the intersection, at the end of a path of length d sec_still. The
// true centroid is the traced one, and the reported depth is the mean path length over sec_still.
inline BeamErrors ErrorsOf(const TracedBeam& traced, const TracedBeam& still) {
  const Eigen::Vector2d tangent = traced.tangent - still.tangent;
  return {tangent, -traced.height_tangent, -tangent, -traced.height_secant / still.secant,
          1 - traced.secant / still.secant};
}

// The effect of one realization of the sea on a beam: the errors on its surface and, where that is also traced upside
// down (which is as likely in a Gaussian sea), on the inverted surface. Each part has a weight in the means of the
// realization; the weights add up to 1.
struct BeamRealization {
  struct Part {
    double share = 0;
    BeamErrors errors;
  };
  std::array<Part, 2> parts;
  // Means over the rays, of the facets above or below the points where they cross z = 0, on the surface of parts[0].
  // Their statistics are known (slope_moments.h). Zero where only tracing is used.
  Eigen::Vector2d mean_slope = Eigen::Vector2d::Zero();
  Eigen::Vector3d mean_squares = Eigen::Vector3d::Zero();
  Eigen::Vector2d height_slope = Eigen::Vector2d::Zero();  // covariance of height and slope over the rays, m
};

// The uncertainty of one beam. Refraction in rad; the others in m, one value for each depth. docs/physics.md, section
// 1, has the definitions.
struct BeamUncertainty {
  Estimate refraction_along_wind, refraction_cross_wind;
  std::vector<Estimate> thu, tvu, bias_along_beam, bias_vertical;
  int realizations = 0;
};

// Whether all values and standard errors are finite. Rays that meet facets from behind may have no intersection.
bool IsFinite(const BeamUncertainty& beam);

// The known statistics of the slopes over which a beam averages: the expectations of the control variates. The `form`
// of the moments is SecantCurvature (closed_form.h).
struct KnownSlopes {
  // Of the means over the rays.
  SlopeMoments moments;
  // Covariance of the slope averaged over the footprint itself. As the expectation of the control variate, it removes
  // the variance that too few rays add.
  Eigen::Matrix2d footprint_covariance;
  // Of the covariance of height and slope within the footprint (HeightSlopeProduct), m^2.
  Eigen::Matrix2d height_slope_covariance;
  // Expectation of the mean slope. It is not zero although slopes are symmetric, because a slanted line meets the side
  // of the long waves that faces it more often.
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
};

// The uncertainty at `depths` [m]. Without `known`, the sample's own statistics: tracing alone. With it, these are
// corrected by control variates (statistics.h), the known part of the errors. To first order in slope, the tangent
// responds to the mean slope by the gains of Snell's law, and the vertical error to the tangent. To second order, the
// lowest order at nadir, the vertical error responds to the mean squares of the slopes. The errors at depth 0, in both
// directions, respond to the covariance of height and slope within the footprint. In a Gaussian sea, first and second
// order are uncorrelated, and so are the two of second order, because one is odd in space and the other even. The
// variance of their sum is therefore the sum of their variances.
BeamUncertainty UncertaintyOf(const std::vector<BeamRealization>& sample, const BeamOptions& beam,
                              double refractive_index, const std::optional<KnownSlopes>& known,
                              const std::vector<double>& depths);

}  // namespace albtpu
