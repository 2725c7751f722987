#include "sea/correlation/slope_lags.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "sea/response/slope_covariance.h"
#include "tests/sea/response/seas.h"

namespace albtpu {
namespace {

Eigen::Array3d Elements(const Eigen::Matrix2d& slopes) { return {slopes(0, 0), slopes(0, 1), slopes(1, 1)}; }

// MovingWaves is tested against sums over waves.
TEST(SlopeLags, AreTheCovariancesOfMovingWaves) {
  for (const WaveMotion& motion : {WaveMotion{.towards = 0.4}, WaveMotion{.travel = WaveTravel::kBothWays}}) {
    const FootprintWaves points = MovingWaves(LongSea(), motion).AtPoints();
    const double whole = points.Between({0, 0}, 0).slopes.trace();
    for (const double later : {0.0, 0.3, -0.8}) {
      const SlopeLags lags(points, motion, later);
      for (const Eigen::Vector2d& lag : {Eigen::Vector2d(0.001, 0), Eigen::Vector2d(0.3, -0.2),
                                         Eigen::Vector2d(-1.5, 1), Eigen::Vector2d(2, 3), Eigen::Vector2d(-6, -4)}) {
        const Eigen::Array3d twin = Elements(points.Between(lag, later).slopes);
        EXPECT_LT((lags.At(lag) - twin).matrix().norm(), 0.006 * whole) << lag.transpose() << " m, " << later << " s";
      }
    }
  }
}

// Across the beam, by the response theory.
TEST(SlopeLags, HaveThePairsOfAFootprint) {
  for (const BeamProfile profile : {BeamProfile::kUniform, BeamProfile::kGaussian}) {
    for (const double incidence : {0.0, 0.4}) {
      for (const double diameter : {0.2, 1.5}) {
        const BeamOptions beam{.incidence = incidence, .azimuth = 0.9, .footprint = diameter, .profile = profile};
        const FootprintKernel footprint(profile, diameter);
        const BeamSpectrum spectrum = SlopeSpectrum(CrossingSea()).AcrossBeam(incidence, beam.azimuth);
        const Eigen::Matrix3d along_beam = SlopePairs(
            LagProducts(LagCovariances(spectrum, static_cast<int>(footprint.overlap().size()))), incidence, footprint);
        const SlopeLags lags(MovingWaves(CrossingSea()).AtPoints(), {}, 0);
        const Eigen::Matrix3d ours = lags.MeanPairs(LagDensity(beam), {0, 0});
        // By a form of each, which are the same in all axes.
        const Eigen::Matrix2d axes = Eigen::Rotation2Dd(beam.azimuth).toRotationMatrix();
        const Eigen::Matrix2d g = (Eigen::Matrix2d() << 1, 0.3, 0.3, 2).finished();
        const Eigen::Matrix2d turned = axes.transpose() * g * axes;
        EXPECT_NEAR(MeanOfForms(g, g, ours) / MeanOfForms(turned, turned, along_beam), 1, 0.01)
            << Name(profile) << ", " << diameter << " m, " << incidence;
      }
    }
  }
}

// Under footprints that are points, at any distance.
TEST(SlopeLags, HaveThePairsOfTwoPoints) {
  const WaveMotion motion{.towards = 1};
  const FootprintWaves points = MovingWaves(LongSea(), motion).AtPoints();
  for (const double later : {0.0, 0.6}) {
    const SlopeLags lags(points, motion, later);
    for (const Eigen::Vector2d& apart : {Eigen::Vector2d(0.04, 0.01), Eigen::Vector2d(-1, 0.7)}) {
      const Eigen::Vector3d r = Elements(points.Between(apart, later).slopes);
      const Eigen::Matrix3d pairs = lags.MeanPairs(LagDensity({.footprint = 0.05}), apart);
      EXPECT_LT((pairs - r * r.transpose()).norm(), 0.02 * pairs.norm()) << apart.transpose() << ", " << later;
    }
  }
}

// On either side of the distance from which pairs are summed about it.
TEST(SlopeLags, HaveTheSamePairsByBothSums) {
  const WaveMotion motion{.towards = 0.2};
  const FootprintWaves points = MovingWaves(WindSeaOf(6), motion).AtPoints();
  const LagDensity density({.footprint = 0.6});
  for (const double later : {0.0, 0.1}) {
    const SlopeLags lags(points, motion, later);
    for (const double beta : {0.0, 0.8, 2.0}) {
      const Eigen::Vector2d apart = 2 * density.reach() * Eigen::Vector2d(std::cos(beta), std::sin(beta));
      const Eigen::Matrix3d near = lags.MeanPairs(density, 0.9999 * apart),
                            far = lags.MeanPairs(density, 1.0001 * apart);
      const Eigen::Matrix3d whole = lags.MeanPairs(density, {0, 0});
      EXPECT_LT((near - far).norm(), 0.002 * whole.norm()) << later << " s, " << beta << "\n" << near << "\n\n" << far;
    }
  }
}

// The mean over a cell is that over pairs of its points.
TEST(SlopeLags, HaveThePairsOfACell) {
  const SlopeLags lags(MovingWaves(WindSeaOf(6)).AtPoints(), {}, 0);
  const BeamOptions beam{.incidence = 0.3, .azimuth = 0.4, .footprint = 0.8};
  for (const double side : {0.3, 1.0}) {
    constexpr int kSteps = 12;
    Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < kSteps; ++j) {
        // Triangles of the square, by midpoints.
        const double x = (i + 0.5) / kSteps, y = (j + 0.5) / kSteps, weight = 2 * (1 - x) * 2 * (1 - y);
        for (const double sign : {-1, 1})
          mean +=
              weight / (2 * kSteps * kSteps) * lags.MeanPairs(LagDensity(beam), side * Eigen::Vector2d(x, sign * y));
      }
    }
    const Eigen::Matrix3d ours = lags.MeanPairs(LagDensity(beam, side, 0), {0, 0});
    EXPECT_LT((ours - mean).norm(), 0.01 * mean.norm()) << side << " m\n" << ours << "\n\n" << mean;
  }
}

}  // namespace
}  // namespace albtpu
