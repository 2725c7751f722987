// From the errors of a beam in many realizations to its uncertainty.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "generator/beam.h"
#include "generator/beam_errors.h"
#include "generator/mean_square_slope.h"
#include "generator/statistics.h"

namespace albtpu {

// What one beam comes to. Refraction in rad, the others in m, one for each depth. docs/physics.md has the definitions.
struct BeamUncertainty {
  Estimate refraction_along_wind, refraction_cross_wind;
  std::vector<Estimate> thu, tvu, bias_along_beam, bias_vertical;
};

// What is known beforehand of the slopes that a beam averages over, over all surfaces: the control variates' moments.
struct KnownSlopes {
  Eigen::Vector2d mean;                                 // of the mean slope
  Eigen::Matrix2d covariance;                           // of the mean slope
  std::optional<MeanSquareSlopeMoments> of_the_square;  // known at nadir, where it is wanted
};

// `depths` in m. Without `known` it is the sample's own statistics: tracing alone. With it, they are
// corrected by what the sample shows of the slopes and what is known of them (statistics.h): to first
// order in slope the tangent answers to the mean slope by the gains of Snell's law, the vertical error to
// the tangent; at nadir the vertical error is -g^2 / 2 times the mean square slope per depth, g = 1 -
// 1/n.
BeamUncertainty UncertaintyOf(const std::vector<BeamErrors>& sample, const BeamOptions& beam,
                              double refractive_index, const std::optional<KnownSlopes>& known,
                              const std::vector<double>& depths);

}  // namespace albtpu
