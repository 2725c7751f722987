#include <gtest/gtest.h>

#include "sea/response/slope_covariance.h"
#include "tests/sea/response/seas.h"

namespace albtpu {
namespace {

// The slow twin by pairs of waves, an independent derivation. For waves h_k, q_a is the sum over pairs of
// h_k h_k' i k'_a (W(k + k') - W(k) W(k')), of which the half that is symmetric in k and k' counts, so that
//     E[q_a q_b] = 1/2 sum over pairs of Psi(k) Psi(k') (k + k')_a (k + k')_b (W(k + k') - W(k) W(k'))^2.
TEST(HeightSlopeCovariance, IsASumOverPairsOfWaves) {
  const HarmonicSpectrum swell = Swell(2e-4, 4, 0.9, 0.5, 0.2);
  for (const BeamProfile profile : {BeamProfile::kUniform, BeamProfile::kGaussian}) {
    for (const double diameter : {0.3, 1.5}) {
      const BeamOptions beam{.incidence = 0.4, .azimuth = 0.5, .footprint = diameter, .profile = profile};
      struct Wave {
        double variance, average;
        Eigen::Vector2d k;
      };
      const auto average = [&](const Eigen::Vector2d& k) {
        return FootprintAverage(beam, k.norm(), std::atan2(k.y(), k.x()));
      };
      std::vector<Wave> waves;
      ForEachWave(swell, 24, [&](double variance, const Eigen::Vector2d& k) {
        if (variance > 1e-9) waves.push_back({variance, average(k), k});
      });
      Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
      for (const Wave& one : waves) {
        for (const Wave& other : waves) {
          const Eigen::Vector2d k = one.k + other.k;
          const double factor = average(k) - one.average * other.average;
          sum += 0.5 * one.variance * other.variance * factor * factor * k * k.transpose();
        }
      }
      const double c = std::cos(beam.azimuth), s = std::sin(beam.azimuth);
      const Eigen::Matrix2d axes = (Eigen::Matrix2d() << c, -s, s, c).finished();
      const Eigen::Matrix2d twin = axes.transpose() * sum * axes;

      const BeamSpectrum spectrum = SlopeSpectrum(swell).AcrossBeam(beam.incidence, beam.azimuth);
      const FootprintKernel footprint(profile, diameter);
      const LagProducts products(LagCovariances(spectrum, static_cast<int>(footprint.overlap().size())));
      const Eigen::Matrix2d ours = HeightSlopeCovariance(spectrum, products, footprint);
      EXPECT_LT((ours - twin).norm(), 0.01 * twin.norm()) << Name(profile) << ", " << diameter << " m\n"
                                                          << ours << "\n"
                                                          << twin;
    }
  }
}

// A plane wave much longer than the footprint is a plane under it: height and slope do not vary together.
TEST(HeightSlopeCovariance, VanishesUnderLongWaves) {
  const BeamSpectrum spectrum = SlopeSpectrum(Swell(0.02, 0.3, 0, 0.8, 0.5)).AcrossBeam(0.3, 0);
  const FootprintKernel footprint(BeamProfile::kUniform, 0.3);
  const LagProducts products(LagCovariances(spectrum, static_cast<int>(footprint.overlap().size())));
  const double slopes = spectrum.slope.col(0).sum().real();
  const Eigen::Matrix2d covariance = HeightSlopeCovariance(spectrum, products, footprint);
  EXPECT_LT(covariance.norm(), 1e-4 * std::pow(0.3 * slopes, 2));
  EXPECT_GE(covariance.diagonal().minCoeff(), 0);
}

}  // namespace
}  // namespace albtpu
