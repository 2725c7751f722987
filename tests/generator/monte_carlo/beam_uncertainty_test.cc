#include "generator/monte_carlo/beam_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sea/response/closed_form.h"

namespace albtpu {
namespace {

// A ray on a surface of one slope m along its azimuth, to second order: the vertical error per depth is a m + b m^2,
// and m is normal with the weight 1 + tau m. Control variates leave the product of the weight's imbalance with both
// orders.
TEST(BeamUncertainty, HasNoBiasFromTheWeightOfTheSurface) {
  constexpr double kVariance = 0.02, kIndex = kRefractiveIndex;
  constexpr int kRealizations = 20000;
  const BeamOptions beam{.incidence = 0.15, .footprint = 0.5};
  const double tau = std::tan(beam.incidence), refracted = StillWaterRefraction(beam.incidence, kIndex);
  const double gain = SmallSlopeGain(beam.incidence, kIndex).in_plane;
  const Eigen::Matrix2d form = SecantCurvature(beam.incidence, 0, kIndex);
  const double a = -std::sin(refracted) * std::cos(refracted) * gain;
  const double b = -0.5 * std::cos(refracted) * form(0, 0);
  std::mt19937_64 bits(1);
  std::normal_distribution<double> slope(0, std::sqrt(kVariance));
  std::vector<BeamRealization> sample(kRealizations);
  for (BeamRealization& realization : sample) {
    const double m = slope(bits);
    for (const int part : {0, 1}) {
      const double here = part == 0 ? m : -m;
      realization.parts[part].share = 0.5 * (1 + tau * here);
      BeamErrors& errors = realization.parts[part].errors;
      errors.tangent.x() = gain * here;
      errors.horizontal_per_depth.x() = -gain * here;
      errors.vertical_per_depth = a * here + b * here * here;
    }
    realization.mean_slope.x() = m;
    realization.mean_squares.x() = m * m;
  }
  KnownSlopes known;
  known.moments.covariance = known.footprint_covariance = Eigen::Vector2d(kVariance, 0).asDiagonal();
  known.moments.expected_squares = Eigen::Vector3d(kVariance, 0, 0);
  known.moments.variance_of_form = 2 * std::pow(form(0, 0) * kVariance, 2);
  known.height_slope_covariance.setZero();
  known.mean = Eigen::Vector2d(tau * kVariance, 0);

  const double mean = a * tau * kVariance + b * kVariance;
  const double square =
      a * a * kVariance + 3 * std::pow(b * kVariance, 2) + 2 * a * b * 3 * tau * kVariance * kVariance;
  const double exact = 2 * std::sqrt(square - mean * mean);
  const Estimate plain = UncertaintyOf(sample, beam, kIndex, {}, {1}).tvu[0];
  const Estimate controlled = UncertaintyOf(sample, beam, kIndex, known, {1}).tvu[0];
  EXPECT_NEAR(plain.value, exact, 4 * plain.standard_error);
  EXPECT_NEAR(controlled.value, exact, 4 * controlled.standard_error);
  EXPECT_LT(controlled.standard_error, 0.001 * exact);  // the control explains nearly all
}

}  // namespace
}  // namespace albtpu
