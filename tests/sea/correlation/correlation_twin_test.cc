// What pulses share, and the slow twin: plain sums over waves and pairs of waves, each by its own formula.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sea/correlation/correlated_pulses.h"
#include "sea/correlation/pulse_correlation.h"
#include "sea/response/slope_covariance.h"
#include "tests/sea/response/seas.h"

namespace albtpu {
namespace {

using Eigen::Vector2d;

constexpr double kAllowed = 1e-4;  // of a correlation

double SquareOfSinc(double x) { return std::abs(x) < 1e-6 ? 1 : std::pow(std::sin(x) / x, 2); }

// What is left of the power of a wave in the mean over a footprint anywhere in a cell; no cell if its side is 0.
double Power(const BeamOptions& beam, const SurfaceCell& cell, const Vector2d& k) {
  const Vector2d side(std::cos(cell.orientation), std::sin(cell.orientation)), other(-side.y(), side.x());
  return FootprintPower(beam, k.norm(), std::atan2(k.y(), k.x())) * SquareOfSinc(cell.side / 2 * k.dot(side)) *
         SquareOfSinc(cell.side / 2 * k.dot(other));
}

// The variances of slopes along x and along y, and of heights.
Eigen::Array3d Variances(const HarmonicSpectrum& sea, const BeamOptions& beam, const SurfaceCell& cell) {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  ForEachWave(sea, 720, [&](double variance, const Vector2d& k) {
    if (k.norm() * beam.footprint > 300) return;  // of which a footprint leaves 1e-7
    sum += variance * Power(beam, cell, k) * Eigen::Array3d(k.x() * k.x(), k.y() * k.y(), 1);
  });
  return sum;
}

// The mean over pairs of points of products of R_xx, R_xy and R_yy, which a product of cosines makes a sum over pairs
// of waves: the one of the sum of their wavenumbers, and the one of the difference.
Eigen::Matrix3d Pairs(const HarmonicSpectrum& sea, const BeamOptions& beam, const SurfaceCell& cell) {
  struct Wave {
    Vector2d k;
    Eigen::Vector3d slopes;
  };
  std::vector<Wave> waves;
  // A wave and the one that travels the opposite way have the same covariance.
  ForEachWave(sea, 48, [&](double variance, const Vector2d& k) {
    if (k.y() > 0 && variance * k.squaredNorm() > 1e-9)
      waves.push_back({k, 2 * variance * Eigen::Vector3d(k.x() * k.x(), k.x() * k.y(), k.y() * k.y())});
  });
  Eigen::Matrix3d pairs = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < waves.size(); ++i) {
    Eigen::Vector3d with = Eigen::Vector3d::Zero();
    for (std::size_t j = 0; j <= i; ++j) {
      const double power = Power(beam, cell, waves[i].k + waves[j].k) + Power(beam, cell, waves[i].k - waves[j].k);
      with += power / (j == i ? 4 : 2) * waves[j].slopes;
    }
    pairs += waves[i].slopes * with.transpose();
  }
  return pairs + pairs.transpose();
}

// Without waves so short that sums over pairs of them need millions.
HarmonicSpectrum Smooth(HarmonicSpectrum sea) {
  for (std::size_t i = 0; i < sea.size(); ++i) sea.s[i] *= std::exp(-std::pow(sea.k[i] / 3, 2));
  return sea;
}

const BeamOptions kBeams[] = {{.footprint = 0.6},
                              {.incidence = 0.35, .azimuth = 0.7, .footprint = 0.6},
                              {.incidence = 0.35, .azimuth = 2, .footprint = 2, .profile = BeamProfile::kGaussian}};

TEST(CorrelationTwin, HasTheSlopesAndHeightsOfCells) {
  for (const HarmonicSpectrum& spectrum : {WindSeaOf(6), CrossingSea()}) {
    const WaveCorrelation sea(spectrum);
    for (const BeamOptions& beam : kBeams) {
      const BeamCorrelation ours(sea, beam, kRefractiveIndex);
      const Eigen::Array3d whole = Variances(spectrum, beam, {.side = 0});
      for (const double side : {0.1, 0.5, 1.0, 2.0, 5.0, 20.0}) {
        const SurfaceCell cell{.side = side, .orientation = 0.3};
        const PulseCorrelation found = CorrelationOf(ours.InCell(cell), ours.pulse());
        const Eigen::Array3d twin = Variances(spectrum, beam, cell) / whole;
        EXPECT_NEAR(found.slope_x, twin[0], kAllowed) << side << " m, " << beam.incidence;
        EXPECT_NEAR(found.slope_y, twin[1], kAllowed) << side << " m, " << beam.incidence;
        EXPECT_NEAR(found.height, twin[2], kAllowed) << side << " m, " << beam.incidence;
      }
    }
  }
}

TEST(CorrelationTwin, HasTheProductsOfSlopesOfCells) {
  for (const HarmonicSpectrum& spectrum : {Smooth(WindSeaOf(6)), Swell(2e-3, 1.5, 1.0, 0.6, 0.3)}) {
    const SlopeLags lags(MovingWaves(spectrum).AtPoints(), {}, 0);
    for (const BeamOptions& beam : kBeams) {
      const Eigen::Matrix3d whole = Pairs(spectrum, beam, {.side = 0});
      const Eigen::Matrix3d one = lags.MeanPairs(LagDensity(beam), {0, 0});
      for (const double side : {0.1, 2.0}) {
        const SurfaceCell cell{.side = side, .orientation = 0.3};
        const Eigen::Matrix3d twin = Pairs(spectrum, beam, cell) / whole.trace();
        const Eigen::Matrix3d found = lags.MeanPairs(LagDensity(beam, side, 0.3), {0, 0}) / one.trace();
        EXPECT_LT((found - twin).cwiseAbs().maxCoeff(), kAllowed) << side << " m, " << beam.incidence;
      }
    }
  }
}

}  // namespace
}  // namespace albtpu
