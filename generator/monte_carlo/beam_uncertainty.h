// From the errors of a beam in many realizations to its uncertainty.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "generator/math/statistics.h"
#include "generator/monte_carlo/beam_errors.h"
#include "generator/monte_carlo/slope_moments.h"
#include "generator/surface/beam.h"

namespace albtpu {

// What one beam comes to. Refraction in rad, the others in m, one for each depth. docs/physics.md has the
// definitions.
struct BeamUncertainty {
  Estimate refraction_along_wind, refraction_cross_wind;
  std::vector<Estimate> thu, tvu, bias_along_beam, bias_vertical;
  int realizations = 0;
};

// What is known beforehand of the slopes that a beam averages over: the expectations of the control variates.
// The `form` of the moments is SecantCurvature (refraction.h).
struct KnownSlopes {
  // Of what the rays make of the slopes.
  SlopeMoments moments;
  // Of the slope averaged over the footprint itself: with this as the expectation, what too few rays add is
  // taken back.
  Eigen::Matrix2d footprint_covariance;
  // Of the covariance of height and slope within the footprint (HeightSlopeProduct), m^2.
  Eigen::Matrix2d height_slope_covariance;
  // Of the mean slope. A slanted line meets the side of the long waves that faces it more often: not zero,
  // though slopes are as often up as down.
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
};

// `depths` in m. Without `known` it is the sample's own statistics: tracing alone. With it, they are
// corrected by what the sample shows of the slopes and what is known of them (statistics.h): to first order
// in slope the tangent answers to the mean slope by the gains of Snell's law and the vertical error to the
// tangent; to second order, which is all there is of it at nadir, the vertical error answers to the mean
// squares of the slopes, and the error at depth 0, in both directions, to how height and slope go together
// within the footprint. First and second order do not go together in a Gaussian sea, nor do the two of second
// order, of which one is odd in space and one is even, so that the variance of their sum is that of each.
BeamUncertainty UncertaintyOf(const std::vector<BeamRealization>& sample, const BeamOptions& beam,
                              double refractive_index, const std::optional<KnownSlopes>& known,
                              const std::vector<double>& depths);

}  // namespace albtpu
