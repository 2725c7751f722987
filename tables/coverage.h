// From 2 sigma, which tables hold, to 95 %, which S-44 compares with.
#pragma once

#include <array>

#include "tables/pulse.h"

namespace albtpu {

enum class Coverage {
  kTwoSigma,  // Twice the standard deviation; THU is twice the root of the summed variances of x and y.
  kP95,       // 1.95996 sigma in one dimension; in two, the radius that holds 95 % of a normal distribution.
};

// The 95 % radius of a centred two-dimensional normal distribution, over twice the root of its summed
// variances. `axis_ratio` is the smaller over the larger standard deviation, 0 to 1; the result falls from
// 0.980 at 0 (one dimension) to 0.865 at 1 (isotropic). Correct to 1e-6.
double RadiusFactor95(double axis_ratio);

// The 95 % radius over the THU of values at 2 sigma and at one azimuth: RadiusFactor95 at the axis ratio of
// the along and cross refraction, their correlation neglected.
double RadiusOverThu(const std::array<float, kQuantityCount>& values);

// The larger of two 95 % radii over the larger of their THU: what stands for both azimuths, a and b.
double LargerRadiusOverThu(double thu_a, double radius_over_thu_a, double thu_b, double radius_over_thu_b);

// The 97.5 % quantile of the standard normal distribution, over 2: from 2 sigma to 95 % in one dimension.
inline constexpr double kFactor95 = 1.959963984540054 / 2;

// The values and standard errors of `uncertainty`, given at 2 sigma, restated; THU by its `radius_over_thu`.
// Biases are means and stay.
PulseUncertainty WithCoverage(PulseUncertainty uncertainty, Coverage coverage);

}  // namespace albtpu
