#include "sea/response/footprint_shift.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "tests/sea/response/seas.h"

namespace albtpu {
namespace {

FootprintShift ShiftOf(const HarmonicSpectrum& sea, double azimuth, double incidence,
                       const FootprintKernel& footprint) {
  const BeamSpectrum spectrum = SlopeSpectrum(sea).AcrossBeam(incidence, azimuth);
  const LagProducts products(LagCovariances(spectrum, static_cast<int>(footprint.overlap().size())));
  return FootprintShiftOf(spectrum, products, SlopePairs(products, incidence, footprint), footprint);
}

// The slow twin, without partial integration: third and fourth derivatives of the waves of a narrow sea, at the lags of
// two points on the ellipse on the water, whose density is the overlap.
TEST(FootprintShift, IsTheMeanOverPairsOfPointsOfTheFootprint) {
  constexpr double kIncidence = 0.5, kAzimuth = 0.8;
  const HarmonicSpectrum sea = Swell(2e-4, 4, 0.3, 0.6, 0.3);
  std::vector<std::pair<double, Eigen::Vector2d>> waves;  // along and across the azimuth
  ForEachWave(sea, 64, [&](double variance, const Eigen::Vector2d& k) {
    if (variance < 1e-10) return;
    waves.emplace_back(variance, Eigen::Vector2d(k.x() * std::cos(kAzimuth) + k.y() * std::sin(kAzimuth),
                                                 k.y() * std::cos(kAzimuth) - k.x() * std::sin(kAzimuth)));
  });
  for (const BeamProfile profile : {BeamProfile::kUniform, BeamProfile::kGaussian}) {
    for (const double diameter : {0.4, 1.2, 5.0}) {
      const double reach = profile == BeamProfile::kUniform ? 1 : 2.2;
      Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
      std::array<Eigen::Matrix2d, 2> drift = {spread, spread};
      double weights = 0;
      constexpr int kSteps = 60, kDirections = 24;
      for (int i = 0; i < kSteps; ++i) {
        const double s = reach * (i + 0.5) / kSteps;
        const double weight = s * FootprintOverlap(profile, s);
        for (int j = 0; j < kDirections; ++j) {
          const double beta = std::numbers::pi * (j + 0.5) / kDirections;
          const Eigen::Vector2d lag =
              diameter * s * Eigen::Vector2d(std::cos(beta) / std::cos(kIncidence), std::sin(beta));
          double height = 0;
          Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
          Eigen::Matrix2d third = Eigen::Matrix2d::Zero(), fourth = third;  // d_x and d_x d_x of R
          for (const auto& [variance, k] : waves) {
            const double phase = k.dot(lag), cosine = std::cos(phase), sine = std::sin(phase);
            const Eigen::Matrix2d slopes = k * k.transpose();
            height += variance * (1 - cosine);
            gradient += variance * sine * k;
            third -= variance * k.x() * sine * slopes;
            fourth -= variance * k.x() * k.x() * cosine * slopes;
          }
          spread += weight * height * fourth;
          for (int c = 0; c < 2; ++c) drift[c] += weight * gradient[c] * third;
          weights += weight;
        }
      }
      const FootprintShift ours = ShiftOf(sea, kAzimuth, kIncidence, FootprintKernel(profile, diameter));
      spread /= weights;
      EXPECT_LT((ours.spread - spread).norm(), 0.01 * spread.norm()) << Name(profile) << ", " << diameter << " m\n"
                                                                     << ours.spread << "\n\n"
                                                                     << spread;
      for (int c = 0; c < 2; ++c) {
        drift[c] /= weights;
        EXPECT_LT((ours.drift[c] - drift[c]).norm(), 0.01 * drift[0].norm())
            << Name(profile) << ", " << diameter << " m\n"
            << ours.drift[c] << "\n\n"
            << drift[c];
      }
    }
  }
}

TEST(FootprintShift, VanishesUnderLongWaves) {
  const HarmonicSpectrum sea = Swell(0.02, 0.5, 1.0, 0.7, 0.3);
  const FootprintShift shift = ShiftOf(sea, 0, 0.4, FootprintKernel(BeamProfile::kUniform, 0.05));
  const double slopes = SlopeSpectrum(sea).Covariance().trace();
  EXPECT_LT(shift.spread.norm(), 2e-3 * slopes * slopes);
  for (const Eigen::Matrix2d& drift : shift.drift) EXPECT_LT(drift.norm(), 2e-3 * slopes * slopes);
}

}  // namespace
}  // namespace albtpu
