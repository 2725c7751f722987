#include "sea/response/slope_covariance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sea/response/footprint_kernel.h"
#include "sea/sea_state.h"
#include "tests/sea/response/seas.h"

namespace albtpu {
namespace {

// The covariance in x and y turned along and across the azimuth.
Eigen::Matrix2d AlongAzimuth(const Eigen::Matrix2d& covariance, double azimuth) {
  const double c = std::cos(azimuth), s = std::sin(azimuth);
  const Eigen::Matrix2d axes = (Eigen::Matrix2d() << c, -s, s, c).finished();
  return axes.transpose() * covariance * axes;
}

// The slow twin is sea_state.h, which sums the waves in five times finer steps and in 32 directions.
TEST(FootprintSlopes, AreTheIntegralOverAllWaves) {
  for (const BeamProfile profile : kProfiles) {
    for (const double footprint : {0.1, 0.6, 4.0}) {
      const BeamOptions beam{.incidence = 0.5, .azimuth = 0.8, .footprint = footprint, .profile = profile};
      const SeaState sea(SeaOptions{.waves = WindSea{.wind_speed_10m = 7, .model = &kElfouhailyModel}});
      const Eigen::Matrix2d exact = AlongAzimuth(
          SlopeCovariance(sea, [&](double k, double psi) { return FootprintPower(beam, k, psi); }), beam.azimuth);
      const Eigen::Matrix2d ours = FootprintSlopes(SlopeSpectrum(WindSeaOf(7)).AcrossBeam(beam.incidence, beam.azimuth),
                                                   FootprintKernel(profile, footprint));
      EXPECT_LT((ours - exact).norm(), 1e-3 * exact.norm()) << Name(profile) << footprint;
    }
  }
}

TEST(FootprintSlopes, AreTheIntegralOverCrossingWaves) {
  const BeamOptions beam{.incidence = 0.4, .azimuth = 2.5, .footprint = 1.5};
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  ForEachWave(CrossingSea(), 64, [&](double variance, const Eigen::Vector2d& k) {
    sum += variance * FootprintPower(beam, k.norm(), std::atan2(k.y(), k.x())) * k * k.transpose();
  });
  const Eigen::Matrix2d ours =
      FootprintSlopes(SlopeSpectrum(CrossingSea()).AcrossBeam(0.4, 2.5), FootprintKernel(BeamProfile::kUniform, 1.5));
  EXPECT_LT((ours - AlongAzimuth(sum, 2.5)).norm(), 5e-4 * sum.norm());
}

// The slow twin: pairs of points on the ellipse on the water, R by the sum of the waves of a narrow sea.
TEST(SlopePairs, AreMeansOverPairsOfPointsOfTheFootprint) {
  constexpr double kIncidence = 0.5, kAzimuth = 0.8, kDiameter = 1.2;
  const HarmonicSpectrum sea = Swell(2e-4, 4, 0.3, 0.6, 0.3);
  std::vector<std::pair<double, Eigen::Vector2d>> waves;  // along and across the azimuth
  ForEachWave(sea, 24, [&](double variance, const Eigen::Vector2d& k) {
    if (variance < 1e-10) return;
    waves.emplace_back(variance, Eigen::Vector2d(k.x() * std::cos(kAzimuth) + k.y() * std::sin(kAzimuth),
                                                 k.y() * std::cos(kAzimuth) - k.x() * std::sin(kAzimuth)));
  });
  // The lag of two points has the density of the overlap.
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double weights = 0;
  constexpr int kSteps = 24, kDirections = 24;
  for (int i = 0; i < kSteps; ++i) {
    const double s = (i + 0.5) / kSteps;
    const double weight = s * FootprintOverlap(BeamProfile::kUniform, s);
    for (int j = 0; j < kDirections; ++j) {
      const double beta = std::numbers::pi * (j + 0.5) / kDirections;
      const Eigen::Vector2d lag =
          kDiameter * s * Eigen::Vector2d(std::cos(beta) / std::cos(kIncidence), std::sin(beta));
      Eigen::Vector3d r = Eigen::Vector3d::Zero();
      for (const auto& [variance, k] : waves)
        r += variance * std::cos(k.dot(lag)) * Eigen::Vector3d(k.x() * k.x(), k.x() * k.y(), k.y() * k.y());
      sum += weight * r * r.transpose();
      weights += weight;
    }
  }
  sum /= weights;
  const BeamSpectrum spectrum = SlopeSpectrum(sea).AcrossBeam(kIncidence, kAzimuth);
  const FootprintKernel footprint(BeamProfile::kUniform, kDiameter);
  const Eigen::Matrix3d ours = SlopePairs(
      LagProducts(LagCovariances(spectrum, static_cast<int>(footprint.overlap().size()))), kIncidence, footprint);
  EXPECT_LT((ours - sum).norm(), 0.005 * sum.norm()) << ours << "\n\n" << sum;
}

// In a footprint that is small beside the waves all its points have one slope.
TEST(SlopePairs, OfOneSlopeAreProductsOfItsCovariance) {
  const SlopeSpectrum sea(Swell(0.02, 0.5, 1.0, 0.7, 0.3));
  const FootprintKernel footprint(BeamProfile::kUniform, 0.05);
  const LagCovariances lags(sea.AcrossBeam(0.4, 0), static_cast<int>(footprint.overlap().size()));
  const Eigen::Matrix3d pairs = SlopePairs(LagProducts(lags), 0.4, footprint);
  const Eigen::Matrix2d r = sea.Covariance();
  const Eigen::Vector3d elements(r(0, 0), r(0, 1), r(1, 1));
  EXPECT_LT((pairs - elements * elements.transpose()).norm(), 2e-3 * pairs.norm());

  const Eigen::Matrix2d g = (Eigen::Matrix2d() << 1, 0.3, 0.3, 2).finished(),
                        h = (Eigen::Matrix2d() << 0.5, -0.2, -0.2, 1).finished();
  EXPECT_NEAR(MeanOfForms(g, h, elements * elements.transpose()), (g * r * h * r).trace(), 1e-15);
}

// All but 1e-4 of the slope lies in the energetic range, of which the wavenumbers of seas leave out the waves below 2
// mm.
TEST(SlopeSpectrum, HasTheSlopesOfTheSea) {
  for (const SpectrumModel* model : kSpectrumModels) {
    const Eigen::Matrix2d exact =
        SlopeCovariance(SeaState(SeaOptions{.waves = WindSea{.wind_speed_10m = 8, .model = model}}));
    const Eigen::Matrix2d ours = SlopeSpectrum(WindSeaOf(8, *model)).Covariance();
    EXPECT_LT((ours - exact).norm(), 5e-4 * exact.norm()) << model->key;
  }
}

TEST(SlopeSpectrum, HasTheSlopesOfCrossingWaves) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  ForEachWave(CrossingSea(), 16,
              [&](double variance, const Eigen::Vector2d& k) { sum += variance * k * k.transpose(); });
  EXPECT_LT((SlopeSpectrum(CrossingSea()).Covariance() - sum).norm(), 1e-12);
}

TEST(SlopeSpectrum, IsInterpolatedBetweenTheSamplesOfAnother) {
  HarmonicSpectrum coarse{{0.5, 1, 2}, {1, 2, 0}, {{0.2, 0.2, 0.2}}, {{0, 0, 0}}};
  const Eigen::Matrix2d slopes = SlopeSpectrum(coarse).Covariance();
  // Integrals of S k^2 of the two straight lines: 2 k from 0.5 to 1, 4 - 2 k from 1 to 2. Trapezoids of 5 % and the cut
  // at 0.5 err by half a step there.
  const double mean_square = (1 - 0.0625) / 2 + 4 * 7 / 3.0 - (16 - 1) / 2.0;
  EXPECT_NEAR(slopes.trace(), mean_square, 0.5 * 0.05 * 0.25);
  EXPECT_NEAR(slopes(0, 0) / slopes(1, 1), 1.2 / 0.8, 1e-12);
}

// At nadir the coordinates across the beam are those of the water, turned by the azimuth.
TEST(BeamSpectrum, IsThatOfTheSeaAtNadir) {
  const SlopeSpectrum sea(CrossingSea());
  const BeamSpectrum straight = sea.AcrossBeam(0, 0), turned = sea.AcrossBeam(0, 0.7);
  for (int m = 0; m <= straight.harmonics(); ++m) {
    const std::complex<double> turn = std::polar(1.0, 2 * m * 0.7);
    EXPECT_LT((straight.slope.col(m) * turn - turned.slope.col(m)).norm(), 1e-12) << m;
  }
  EXPECT_NEAR(straight.slope.col(0).sum().real(), sea.Covariance().trace(), 1e-12);
  EXPECT_NEAR(straight.slope.col(1).sum().real(), sea.Covariance()(0, 0) - sea.Covariance()(1, 1), 1e-12);
  EXPECT_NEAR(-straight.slope.col(1).sum().imag(), 2 * sea.Covariance()(0, 1), 1e-12);
}

// kappa = (k along / cos(incidence), k across), for each wave of a fine grid.
TEST(BeamSpectrum, CountsWavesByTheirWavenumberAcrossTheBeam) {
  constexpr double kIncidence = 0.5, kAzimuth = 0.4;
  const HarmonicSpectrum swell = Swell(0.02, 0.5, 1.0, 0.7, 0.3);
  const BeamSpectrum spectrum = SlopeSpectrum(swell).AcrossBeam(kIncidence, kAzimuth);
  std::vector<std::complex<double>> sums(spectrum.harmonics() + 1);
  double height = 0, height_here = 0;
  ForEachWave(swell, 256, [&](double variance, const Eigen::Vector2d& k) {
    const double along = (k.x() * std::cos(kAzimuth) + k.y() * std::sin(kAzimuth)) / std::cos(kIncidence);
    const double across = k.y() * std::cos(kAzimuth) - k.x() * std::sin(kAzimuth);
    const double squared = along * along + across * across, psi = std::atan2(across, along);
    height += variance;
    for (std::size_t m = 0; m < sums.size(); ++m) sums[m] += variance * squared * std::polar(1.0, -2.0 * m * psi);
  });
  const Eigen::ArrayXd k = HankelLattice::Shared().wavenumbers();
  height_here = (spectrum.slope.col(0).real().array() / k.square()).sum();
  EXPECT_NEAR(height_here / height, 1, 1e-4);
  for (std::size_t m = 0; m < sums.size(); ++m)
    EXPECT_LT(std::abs(spectrum.slope.col(m).sum() - sums[m]), 1e-4 * sums[0].real()) << m;
}

// The slow twin: cosines of the waves of a fine grid, on lags in all directions. The sea has no waves so short that the
// grid would alias them at these lags.
TEST(LagCovariances, AreSumsOfCosines) {
  const HarmonicSpectrum sea = WeightedSum(Swell(2e-4, 6, 1.0, 0.6, 0.3), 1, Swell(1e-4, 2, -0.3, 0.8, 0.5), 1);
  constexpr int kLags = 75;
  const LagCovariances covariances(SlopeSpectrum(sea).AcrossBeam(0, 0), kLags);
  for (const int j : {0, 20, 50, 62, 70}) {
    const double lag = HankelLattice::Shared().Lag(j * FootprintKernel::kLagStride);
    for (const Eigen::Index d : {0, 2, 5}) {
      const Eigen::Vector2d n(std::cos(covariances.directions[d]), std::sin(covariances.directions[d]));
      Eigen::Matrix2d slopes = Eigen::Matrix2d::Zero();
      Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
      double height = 0, variance = 0;
      ForEachWave(sea, 128, [&](double power, const Eigen::Vector2d& k) {
        const double phase = lag * k.dot(n);
        slopes += power * std::cos(phase) * k * k.transpose();
        gradient += lag * power * std::sin(phase) * k;
        height += power * (1 - std::cos(phase));
        variance += power * k.squaredNorm();
      });
      // Waves between the samples: 5 % steps alter the cosines by (0.05 k lag)^2 / 12, the harmonics end at the sixth.
      const double allowed = 0.005 * variance;
      EXPECT_NEAR(covariances.along(j, d), slopes(0, 0), allowed) << lag << " m, " << d;
      EXPECT_NEAR(covariances.both(j, d), slopes(0, 1), allowed) << lag << " m, " << d;
      EXPECT_NEAR(covariances.across(j, d), slopes(1, 1), allowed) << lag << " m, " << d;
      EXPECT_NEAR(covariances.height(j, d) / height, 1, 0.005) << lag << " m, " << d;
      EXPECT_NEAR(covariances.height_along(j, d), gradient.x(), 0.01 * height) << lag << " m, " << d;
      EXPECT_NEAR(covariances.height_across(j, d), gradient.y(), 0.01 * height) << lag << " m, " << d;
    }
  }
}

// The means over 64 directions of the trigonometric polynomials through the values.
TEST(LagProducts, AreMeansOverAllDirections) {
  const LagCovariances r(SlopeSpectrum(CrossingSea()).AcrossBeam(0.4, 0.9), 60);
  const LagProducts products(r);
  constexpr int kLag = 45, kDirections = 64;
  const auto count = static_cast<int>(r.directions.size());
  // Of even harmonics, 2 l, or of odd ones, 2 l + 1.
  const auto at = [&](const Eigen::ArrayXXd& values, double beta, bool odd) {
    double sum = 0;
    for (int d = 0; d < count; ++d) {
      double kernel = 0;
      for (int l = -(count - 1) / 2; l <= (count - 1) / 2; ++l)
        kernel += std::cos((2 * l + (odd ? 1 : 0)) * (beta - r.directions[d]));
      sum += kernel / count * values(kLag, d);
    }
    return sum;
  };
  double pair = 0, squared = 0, turned = 0, gradient = 0;
  for (int d = 0; d < kDirections; ++d) {
    const double beta = 2 * std::numbers::pi * (d + 0.3) / kDirections;
    const double along = at(r.along, beta, false), both = at(r.both, beta, false);
    const double height = at(r.height, beta, false);
    pair += along * both / kDirections;
    squared += height * height * std::cos(beta) * std::sin(beta) / kDirections;
    turned += height * both * std::cos(2 * beta) / kDirections;
    gradient += at(r.height_across, beta, true) * along * std::cos(beta) / kDirections;
  }
  const double slope = r.along.abs().maxCoeff(), height = r.height.row(kLag).maxCoeff();
  EXPECT_NEAR(products.slope_pairs(kLag, 1), pair, 1e-10 * slope * slope);
  EXPECT_NEAR(products.squared_heights(kLag, 1), squared, 1e-10 * height * height);
  EXPECT_NEAR(products.turned_height_slopes(kLag, 1), turned, 1e-10 * height * slope);
  EXPECT_NEAR(products.gradient_slopes(kLag, 3), gradient, 1e-10 * height * slope);
}

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
