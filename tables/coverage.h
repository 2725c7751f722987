// Restates uncertainties from 2 sigma, as tables hold them, at 95 %, the level of the limits of S-44.
#pragma once

#include <array>

#include "tables/pulse.h"

namespace albtpu {

enum class Coverage {
  kTwoSigma,  // Twice the standard deviation; THU is twice the root of the summed variances of x and y.
  kOneSigma,  // Half of that: a root mean square error, as ASPRS states accuracy.
  kP95,       // 1.95996 sigma in one dimension; in two, the radius that contains 95 % of a normal distribution.
};

// The ratio of the 95 % radius of a centred two-dimensional normal distribution to twice the root of its summed
// variances. `axis_ratio` is the ratio of the smaller to the larger standard deviation, 0 to 1. The result falls from
// 0.980 at 0 (one dimension) to 0.865 at 1 (isotropic). Accurate to 1e-6.
double RadiusFactor95(double axis_ratio);

// The ratio of the 95 % radius to the THU for values at 2 sigma and at one azimuth: RadiusFactor95 at the axis
// ratio of the refraction along and across the wind. It neglects their correlation.
double RadiusOverThu(const std::array<float, kQuantityCount>& values);

// The ratio of the larger of two 95 % radii to the larger of the two THU, for an answer that covers two azimuths, a
// and b.
double LargerRadiusOverThu(double thu_a, double radius_over_thu_a, double thu_b, double radius_over_thu_b);

// From 2 sigma to 95 % in one dimension: half of the 97.5 % quantile of the standard normal distribution.
inline constexpr double kFactor95 = 1.959963984540054 / 2;

// The standard deviations in an uncertainty of one dimension, such as TVU, at this coverage.
constexpr double VerticalFactor(Coverage coverage) {
  return coverage == Coverage::kOneSigma ? 1 : coverage == Coverage::kTwoSigma ? 2 : 2 * kFactor95;
}

// Restates the values and standard errors of `uncertainty`, given at 2 sigma; THU by its `radius_over_thu`. Biases
// are means and do not change.
PulseUncertainty WithCoverage(PulseUncertainty uncertainty, Coverage coverage);

}  // namespace albtpu
