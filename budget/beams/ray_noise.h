// A model of the errors of ray directions, estimated from their residuals to a track.
#pragma once

#include <cstddef>
#include <span>

namespace albtpu {

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
RayNoise FitRayNoise(std::span<const double> squares, std::span<const double> separations,
                     const RayNoise& start, int steps);

// A start for FitRayNoise from medians, which 30 % of outliers do not spoil.
RayNoise RobustRayNoise(std::span<const double> squares, std::span<const double> separations);

}  // namespace albtpu
