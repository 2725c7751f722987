#include "sea/correlation/moving_waves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sea/response/slope_covariance.h"
#include "sea/spectra/spectrum_moments.h"
#include "tests/sea/response/seas.h"

namespace albtpu {
namespace {

constexpr double kPi = std::numbers::pi;

// One wave of the lattice, with its neighbours half as high on either side at most: long-crested along `axis`.
struct OneWave {
  HarmonicSpectrum spectrum{SeaWavenumbers(), {}, {}, {}};
  double k;
};
OneWave WaveAlong(double axis) {
  OneWave wave;
  const std::size_t size = wave.spectrum.size(), at = size / 2;
  wave.k = wave.spectrum.k[at];
  wave.spectrum.s.assign(size, 0);
  wave.spectrum.s[at] = 0.01;
  for (std::size_t n = 1; n <= kSeaHarmonics; ++n) {
    wave.spectrum.a.emplace_back(size, std::cos(2 * static_cast<double>(n) * axis));
    wave.spectrum.b.emplace_back(size, std::sin(2 * static_cast<double>(n) * axis));
  }
  return wave;
}

// The wave counts at two wavenumbers, half a step h of 4.9 % beside k on either side: k exp(h / 2) and k exp(-h / 2).
// Of a phase in proportion to k the cosine is that of phase cosh(h / 2) times the cosine of phase sinh(h / 2).
double AllowedAt(double phase) { return 1e-4 + 0.05 * 0.05 / 8 * (phase + phase * phase); }

HarmonicSpectrum Finer(const HarmonicSpectrum& sea, int parts) {
  std::vector<double> k;
  const double first = sea.k.front(), ratio = std::log(sea.k.back() / first);
  const int steps = parts * static_cast<int>(sea.size() - 1);
  for (int i = 0; i <= steps; ++i) k.push_back(first * std::exp(ratio * i / steps * (1 - 1e-12)));
  return Resampled(sea, k);
}

// The slow twin: sums over single waves.
WaveCovariance SumOfWaves(const HarmonicSpectrum& sea, const BeamOptions& beam, const WaveMotion& motion,
                          const Eigen::Vector2d& apart, double later, const SurfaceCell* cell = nullptr) {
  WaveCovariance sum{Eigen::Matrix2d::Zero(), 0};
  ForEachWave(Finer(sea, 8), 96, [&](double variance, const Eigen::Vector2d& k) {
    if (std::abs(variance) < 1e-12) return;  // of 3e-3 in all
    const double psi = std::atan2(k.y(), k.x()), c = std::cos(psi - motion.towards);
    if (motion.travel == WaveTravel::kOneWay) variance *= 1 + 2 * c / (1 + c * c);
    double power = variance * FootprintPower(beam, k.norm(), psi) *
                   std::cos(k.dot(apart) - AngularFrequency(k.norm(), motion.water_depth) * later);
    if (cell != nullptr) {
      const double turned = psi - cell->orientation;
      for (const double x : {std::cos(turned), std::sin(turned)}) {
        const double phase = k.norm() * x * cell->side / 2;
        if (phase != 0) power *= std::pow(std::sin(phase) / phase, 2);
      }
    }
    sum.slopes += power * k * k.transpose();
    sum.heights += power;
  });
  return sum;
}

void ExpectNear(const WaveCovariance& ours, const WaveCovariance& twin, const WaveCovariance& whole, double allowed) {
  EXPECT_LT((ours.slopes - twin.slopes).norm(), allowed * whole.slopes.norm()) << ours.slopes << "\n\n" << twin.slopes;
  EXPECT_NEAR(ours.heights, twin.heights, allowed * whole.heights);
}

TEST(FootprintWaves, OfOneWaveCorrelateLikeACosine) {
  const double axis = 0.4;
  const auto [spectrum, k] = WaveAlong(axis);
  const Eigen::Vector2d n(std::cos(axis), std::sin(axis));
  const FootprintWaves waves = MovingWaves(spectrum, {.towards = axis}).AtPoints();
  const WaveCovariance whole = waves.Between({0, 0}, 0);
  for (const double phase : {0.3, 1.0, 2.0, 3.0, 4.5}) {
    const WaveCovariance apart = waves.Between(phase / k * n, 0);
    EXPECT_NEAR(apart.heights / whole.heights, std::cos(phase), AllowedAt(phase)) << phase;
    EXPECT_LT((apart.slopes / whole.slopes.trace() - std::cos(phase) * n * n.transpose()).norm(), AllowedAt(phase));
  }
  EXPECT_NEAR(waves.Between(3 / k * Eigen::Vector2d(-n.y(), n.x()), 0).heights / whole.heights, 1, 1e-4);
}

TEST(FootprintWaves, OfOneWaveAreTheSameAfterAPeriod) {
  const auto [spectrum, k] = WaveAlong(0);
  const double period = 2 * kPi / AngularFrequency(k);
  const FootprintWaves waves = MovingWaves(spectrum).AtPoints();
  const WaveCovariance whole = waves.Between({0, 0}, 0);
  EXPECT_NEAR(waves.Between({0, 0}, period).heights / whole.heights, 1, AllowedAt(kPi));
  EXPECT_NEAR(waves.Between({0, 0}, period / 2).heights / whole.heights, -1, AllowedAt(kPi / 2));
  EXPECT_NEAR(waves.Between({0, 0}, -period).heights / whole.heights, 1, AllowedAt(kPi));
}

TEST(FootprintWaves, TravelTheirWay) {
  const double axis = -0.7;
  const auto [spectrum, k] = WaveAlong(axis);
  const double phase = 1.2, later = phase / AngularFrequency(k);
  const Eigen::Vector2d apart = phase / k * Eigen::Vector2d(std::cos(axis), std::sin(axis));
  const auto heights = [&, &line = spectrum](const WaveMotion& motion, double sign, double time) {
    const FootprintWaves waves = MovingWaves(line, motion).AtPoints();
    return waves.Between(sign * apart, time).heights / waves.Between({0, 0}, 0).heights;
  };
  const WaveMotion there{.towards = axis}, back{.towards = axis + kPi}, both{.travel = WaveTravel::kBothWays};
  const double allowed = AllowedAt(2 * phase);
  EXPECT_NEAR(heights(there, 1, later), 1, allowed);
  EXPECT_NEAR(heights(there, -1, later), std::cos(2 * phase), allowed);
  EXPECT_NEAR(heights(there, -1, -later), 1, allowed);
  EXPECT_NEAR(heights(back, 1, later), std::cos(2 * phase), allowed);
  EXPECT_NEAR(heights(both, 1, later), std::pow(std::cos(phase), 2), allowed);
  EXPECT_NEAR(heights(both, -1, later), std::pow(std::cos(phase), 2), allowed);
}

TEST(FootprintWaves, AreSumsOverWaves) {
  const HarmonicSpectrum sea = LongSea();
  struct Lag {
    Eigen::Vector2d apart;
    double later;
  };
  const Lag lags[] = {{{0, 0}, 0}, {{0.5, 0.3}, 0}, {{-2, 1}, 0},    {{4, 7}, 0},
                      {{0, 0}, 1}, {{1, 0}, 0.5},   {{-1, 2}, -0.7}, {{3, -3}, 2.5}};
  for (const WaveMotion& motion : {WaveMotion{.towards = 0.5}, WaveMotion{.travel = WaveTravel::kBothWays},
                                   WaveMotion{.towards = 2, .water_depth = 1.5}}) {
    for (const BeamOptions& beam :
         {BeamOptions{.footprint = 0.5}, BeamOptions{.incidence = 0.45, .azimuth = 0.7, .footprint = 2},
          BeamOptions{.incidence = 0.3, .azimuth = 2, .footprint = 1, .profile = BeamProfile::kGaussian}}) {
      const FootprintWaves waves = MovingWaves(sea, motion).Under(beam);
      const WaveCovariance whole = waves.Between({0, 0}, 0);
      for (const Lag& lag : lags) {
        SCOPED_TRACE(testing::Message() << lag.apart.transpose() << " m, " << lag.later << " s");
        ExpectNear(waves.Between(lag.apart, lag.later), SumOfWaves(sea, beam, motion, lag.apart, lag.later), whole,
                   0.004);
      }
    }
  }
}

TEST(FootprintWaves, HaveTheMeansOverACell) {
  const HarmonicSpectrum sea = LongSea();
  const BeamOptions beam{.incidence = 0.4, .azimuth = -0.5, .footprint = 1};
  const FootprintWaves waves = MovingWaves(sea).Under(beam);
  const WaveCovariance whole = waves.Between({0, 0}, 0);
  for (const double side : {0.3, 1.0, 3.0, 8.0}) {
    for (const double orientation : {0.0, 0.3, 1.3}) {
      const SurfaceCell cell{side, orientation};
      SCOPED_TRACE(testing::Message() << side << " m, turned by " << orientation);
      ExpectNear(waves.InCell(cell), SumOfWaves(sea, beam, {.travel = WaveTravel::kBothWays}, {0, 0}, 0, &cell), whole,
                 0.003);
    }
  }
}

TEST(FootprintWaves, AreThoseOfOnePulseInACellOfAPoint) {
  for (const BeamOptions& beam :
       {BeamOptions{.footprint = 0.2}, BeamOptions{.incidence = 0.5, .azimuth = 0.8, .footprint = 0.6},
        BeamOptions{.incidence = 0.3, .footprint = 3, .profile = BeamProfile::kGaussian}}) {
    const FootprintWaves waves = MovingWaves(CrossingSea()).Under(beam);
    const WaveCovariance whole = waves.Between({0, 0}, 0), cell = waves.InCell({0.01, 0.4});
    ExpectNear(cell, whole, whole, 5e-4);  // (k a)^2 / 12, of waves a few decimetres long
    // By the response theory, which works in the coordinates across the beam.
    const BeamSpectrum spectrum = SlopeSpectrum(CrossingSea()).AcrossBeam(beam.incidence, beam.azimuth);
    const Eigen::Matrix2d axes = Eigen::Rotation2Dd(beam.azimuth).toRotationMatrix();
    const Eigen::Matrix2d theirs =
        axes * FootprintSlopes(spectrum, FootprintKernel(beam.profile, beam.footprint)) * axes.transpose();
    EXPECT_LT((whole.slopes - theirs).norm(), 5e-4 * theirs.norm()) << whole.slopes << "\n\n" << theirs;
  }
}

// Of waves much shorter than a cell those remain that run along its sides: the mean of W_a^2 over all directions is
// 8 / (k a)^3.
TEST(FootprintWaves, AverageOutOverALargeCell) {
  const double k = 4;
  const HarmonicSpectrum sea = Swell(0.01, k, 0, 0, 0);
  const FootprintWaves waves = MovingWaves(sea).AtPoints();
  const WaveCovariance whole = waves.Between({0, 0}, 0);
  for (const double side : {10.0, 20.0, 40.0}) {
    // k is normal in ln k with the deviation 0.3: the mean of k^-3 over heights is that at the peak times this.
    const double mean = std::exp(4.5 * 0.3 * 0.3);
    EXPECT_NEAR(waves.InCell({side}).heights / whole.heights * std::pow(k * side, 3) / (8 * mean), 1, 0.03) << side;
  }
}

}  // namespace
}  // namespace albtpu
