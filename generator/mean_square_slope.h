// The square of the slope averaged over a vertical beam: what its vertical error follows, to second order in slope.
#pragma once

#include <vector>

#include "generator/beam.h"
#include "generator/sea_surface.h"

namespace albtpu {

struct MeanSquareSlopeMoments {
  double mean, variance;
};

// Mean and variance over all surfaces of the mean of |slope|^2 over the facets that `rays`, all vertical, meet. Slopes
// are Gaussian: with R(a, b) the covariance of the slopes of facets a and b (a 2 x 2 matrix) and w their shares of the
// rays, the variance is 2 sum w_a w_b |R(a, b)|^2, |.| the Frobenius norm. The mean is exact. In the variance
// the long waves count as stationary, with the slopes that the window's interpolation leaves them in the mean,
// which errs by less than 2e-4.
MeanSquareSlopeMoments MomentsOfMeanSquareSlope(const SurfaceModel& model, const std::vector<Ray>& rays);

}  // namespace albtpu
