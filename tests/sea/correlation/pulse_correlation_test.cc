#include "sea/correlation/pulse_correlation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sea/correlation/correlated_pulses.h"
#include "sea/response/sea_response.h"
#include "sea/spectra/described_sea.h"
#include "sea/spectra/jonswap.h"
#include "tests/sea/response/seas.h"

namespace albtpu {
namespace {

HarmonicSpectrum Elfouhaily(double wind_speed, double fetch = kFullyDeveloped) {
  return WindWaves(ElfouhailySpectrum(wind_speed, fetch), SeaWavenumbers());
}

TEST(BeamCorrelation, IsOneOfAPulseWithItself) {
  const WaveCorrelation sea(CrossingSea());
  for (const double incidence : {0.0, 0.02, 0.35}) {
    const BeamCorrelation beam(sea, {.incidence = incidence, .azimuth = 1, .footprint = 0.6}, kRefractiveIndex);
    for (const SharedWaves& shared : {beam.Between({0, 0}, 0), beam.InCell({.side = 0.01, .orientation = 0.3})}) {
      const PulseCorrelation found = CorrelationOf(shared, beam.pulse());
      EXPECT_NEAR(found.slope_x, 1, 5e-4);
      EXPECT_NEAR(found.slope_y, 1, 5e-4);
      EXPECT_NEAR(found.horizontal, 1, 5e-4);
      EXPECT_NEAR(found.vertical, 1, 5e-4);
      EXPECT_NEAR(found.vertical_second, 1, 5e-4);
      EXPECT_NEAR(found.height, 1, 5e-4);
    }
  }
}

// The reported point lies along the still-water ray: it differs horizontally from the spot of BeamResponse by the
// vertical error times tan(refracted). At nadir both are one, and the theory has no further terms.
TEST(BeamCorrelation, HasTheVarianceOfOnePulse) {
  for (const double diameter : {0.3, 2.0}) {
    for (const double incidence : {0.0, 0.35}) {
      const BeamOptions beam{.incidence = incidence, .azimuth = 0.7, .footprint = diameter};
      const HarmonicSpectrum spectrum = Elfouhaily(7);
      const WaveCorrelation sea(spectrum);
      const Eigen::Matrix3d ours = BeamCorrelation(sea, beam, kRefractiveIndex).pulse().errors();
      const BeamResponse response = SeaResponse(spectrum, kRefractiveIndex)(beam);
      const double refracted = StillWaterRefraction(incidence, kRefractiveIndex);
      Eigen::Matrix3d reported = Eigen::Matrix3d::Identity();
      reported.topRightCorner<2, 1>() = -std::tan(refracted) * response.azimuth;
      const Eigen::Matrix3d theirs = reported * response.covariance_per_depth * reported.transpose();
      // What heights do to a slanted beam, and R tau tau^T R: some mss tan^2(incidence).
      const double allowed = 0.005 + 0.3 * std::pow(std::tan(incidence), 2);
      EXPECT_NEAR(ours(2, 2) / theirs(2, 2), 1, allowed) << diameter << " m, " << incidence;
      EXPECT_NEAR((ours(0, 0) + ours(1, 1)) / (theirs(0, 0) + theirs(1, 1)), 1, allowed);
    }
  }
}

// The vertical error at nadir is 1/2 g^2 |m|^2 to second order: its correlation is the square of that of the slopes,
// tr(C C) / tr(C_0 C_0), under a footprint that is short beside the waves.
TEST(BeamCorrelation, IsTheSquareOfThatOfSlopesInDepthAtNadir) {
  const WaveCorrelation sea(Swell(0.01, 0.6, 0.4, 0.7, 0.3));
  const BeamCorrelation beam(sea, {.footprint = 0.1}, kRefractiveIndex);
  const Eigen::Matrix2d whole = beam.pulse().footprint.slopes;
  for (const Eigen::Vector2d& apart : {Eigen::Vector2d(0.5, 0), Eigen::Vector2d(1, 1), Eigen::Vector2d(-2, 3)}) {
    for (const double later : {0.0, 0.4}) {
      const SharedWaves shared = beam.Between(apart, later);
      const Eigen::Matrix2d c = shared.footprint.slopes;
      const PulseCorrelation found = CorrelationOf(shared, beam.pulse());
      EXPECT_NEAR(found.vertical, (c * c).trace() / (whole * whole).trace(), 0.01) << apart.transpose();
      EXPECT_NEAR(found.vertical, found.vertical_second, 1e-12);
    }
  }
}

TEST(BeamCorrelation, IsThatOfTheGainsOfASlantedBeam) {
  const WaveCorrelation sea(Swell(2e-5, 1, 0.4, 0.7, 0.3));  // so flat that the second order does not count
  const BeamOptions options{.incidence = 0.35, .azimuth = 0.9, .footprint = 0.5};
  const BeamCorrelation beam(sea, options, kRefractiveIndex);
  const Eigen::Vector2d along(std::cos(0.9), std::sin(0.9));
  const SharedWaves shared = beam.Between({1, -0.5}, 0.2);
  const SlopeGain gain = SmallSlopeGain(options.incidence, kRefractiveIndex);
  const double refracted = StillWaterRefraction(options.incidence, kRefractiveIndex);
  // The path is longer by sin(refracted) times the tangent; the horizontal gain of the reported point is g all around.
  const double down = std::sin(refracted) * std::cos(refracted) * gain.in_plane;
  const Eigen::Matrix2d c = shared.footprint.slopes;
  EXPECT_NEAR(shared.errors()(2, 2), down * down * along.dot(c * along), 1e-3 * beam.pulse().errors()(2, 2));
  const Eigen::Matrix2d horizontal = shared.errors().topLeftCorner<2, 2>();
  const Eigen::Matrix2d whole = beam.pulse().errors().topLeftCorner<2, 2>();
  EXPECT_LT((horizontal - gain.out_of_plane * gain.out_of_plane * c).norm(), 1e-3 * whole.norm());
}

TEST(BeamCorrelation, OfACellIsTheMeanOverPairsOfItsPoints) {
  const WaveCorrelation sea(Elfouhaily(6));
  const BeamCorrelation beam(sea, {.incidence = 0.3, .azimuth = 0.6, .footprint = 0.6}, kRefractiveIndex);
  constexpr double kSide = 1.5;
  constexpr int kSteps = 10;
  PulseCorrelation mean;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double x = (i + 0.5) / kSteps, y = (j + 0.5) / kSteps;
      for (const double sign : {-1, 1}) {
        const double weight = 2 * (1 - x) * (1 - y) / (kSteps * kSteps);
        const PulseCorrelation found =
            CorrelationOf(beam.Between(kSide * Eigen::Vector2d(x, sign * y), 0), beam.pulse());
        mean.horizontal += weight * found.horizontal;
        mean.vertical += weight * found.vertical;
        mean.vertical_second += weight * found.vertical_second;
        mean.height += weight * found.height;
      }
    }
  }
  const PulseCorrelation found = CorrelationOf(beam.InCell({.side = kSide}), beam.pulse());
  EXPECT_NEAR(found.horizontal, mean.horizontal, 0.005);
  EXPECT_NEAR(found.vertical, mean.vertical, 0.005);
  EXPECT_NEAR(found.vertical_second, mean.vertical_second, 0.005);
  EXPECT_NEAR(found.height, mean.height, 0.005);
}

TEST(BeamCorrelation, FallsWithTheSizeOfTheCell) {
  const WaveCorrelation sea(CrossingSea());
  const BeamCorrelation beam(sea, {.incidence = 0.2, .footprint = 0.6}, kRefractiveIndex);
  double last = 1;
  for (const double side : {0.02, 0.1, 0.5, 1.0, 2.0, 5.0, 10.0, 50.0}) {
    const PulseCorrelation found = CorrelationOf(beam.InCell({.side = side}), beam.pulse());
    EXPECT_LT(found.vertical, last) << side;
    EXPECT_GT(found.vertical, 0) << side;
    if (side <= 10) {
      EXPECT_LT(found.vertical_second, found.vertical_first) << side;
    }
    last = found.vertical;
  }
  EXPECT_LT(last, 0.01);
}

// Along their crests waves of one direction have no slope, and what rounding leaves of it has no correlation.
TEST(BeamCorrelation, OfLongCrestsIsOneAtMost) {
  for (const double spread : {0.0, 0.001, 0.01, 0.1}) {
    const auto waves = std::make_shared<JonswapSpectrum>(
        std::vector{JonswapWaves{.significant_wave_height = 1, .peak_period = 6, .spread = spread}});
    const DescribedSea described = Describe({.waves = waves, .wind_speed_10m = 0, .tail = TailRule::kNone});
    const WaveCorrelation sea(described.spectrum);
    const BeamCorrelation beam(sea, {.incidence = 0.17, .footprint = 1}, kRefractiveIndex);
    for (const SharedWaves& shared : {beam.Between({10, 0}, 0), beam.InCell({.side = 5})}) {
      const PulseCorrelation found = CorrelationOf(shared, beam.pulse());
      EXPECT_LE(std::abs(found.slope_x), 1) << spread;
      EXPECT_LE(std::abs(found.slope_y), spread < 0.02 ? 0 : 0.9) << spread;
    }
  }
}

TEST(BeamCorrelation, IsNothingInACalm) {
  const WaveCorrelation calm(FlatSea(SeaWavenumbers(), 1));
  const BeamCorrelation beam(calm, {.footprint = 0.6}, kRefractiveIndex);
  EXPECT_EQ(CorrelationOf(beam.InCell({.side = 1}), beam.pulse()).vertical, 0);
  EXPECT_EQ(CorrelationOf(beam.Between({1, 0}, 1), beam.pulse()).horizontal, 0);
}

TEST(CorrelatedPulses, HaveTheRatiosOfTheCovariances) {
  const WaveMotion motion{.towards = 0.3, .water_depth = 6};
  const WaveCorrelation sea(CrossingSea(), motion);
  const BeamCorrelation beam(
      sea, {.incidence = 0.2, .azimuth = 0.8, .footprint = 0.6, .profile = BeamProfile::kGaussian}, 1.34);
  const CorrelatedPulses pulses(
      CrossingSea(), {.incidence = 0.2, .azimuth = 0.8, .footprint = 0.6, .gaussian = true, .refractive_index = 1.34},
      motion);
  EXPECT_EQ(pulses.Between(1, -0.4, 0.2).vertical, CorrelationOf(beam.Between({1, -0.4}, 0.2), beam.pulse()).vertical);
  EXPECT_EQ(pulses.InCell({.side = 2, .orientation = 0.4}).horizontal,
            CorrelationOf(beam.InCell({.side = 2, .orientation = 0.4}), beam.pulse()).horizontal);
}

TEST(MeanOfPulses, IsThatOfOneForOnePulseAndOfTheCellForMany) {
  EXPECT_EQ(MeanOfPulses(0.3, 1), 1);
  EXPECT_EQ(MeanOfPulses(0, 10), 0.1);
  EXPECT_NEAR(MeanOfPulses(0.3, 1e12), 0.3, 1e-11);
  EXPECT_NEAR(MeanOfPulses(0.76, 10), 0.784, 1e-12);
}

// R of the slopes at nadir by a plain sum over fine wavenumbers and directions.
Eigen::Array2d SumOverWaves(const ElfouhailySpectrum& spectrum, double diameter, double side) {
  constexpr double kStep = 0.005;  // of ln k
  constexpr int kDirections = 64;  // of a turn
  Eigen::Array2d in_cell = Eigen::Array2d::Zero(), all = Eigen::Array2d::Zero();
  for (double k = 0.004; k < 400; k *= 1 + kStep) {
    const double power = kStep * std::pow(k, 3) * spectrum(k) * FootprintPower({.footprint = diameter}, k, 0);
    for (int d = 0; d < kDirections; ++d) {
      const double psi = 2 * std::numbers::pi * (d + 0.5) / kDirections;
      const Eigen::Array2d n(std::cos(psi), std::sin(psi)), phase = k * side / 2 * n;
      const Eigen::Array2d here = power * spectrum.Spreading(k, psi) * n.square();
      all += here;
      in_cell += here * (phase.sin() / phase).square().prod();
    }
  }
  return in_cell / all;
}

// R along and across the wind at nadir, under 0.6 m, of a prototype by sums over a square lattice of wavenumbers,
// printed with two digits. The fine sum is within 0.0005 of half a digit of all forty; two lie beyond it.
TEST(BeamCorrelation, AgreesWithSumsOverWavesAndWithTheTableOfWinds) {
  struct Row {
    double wind_speed, fetch;
    double along[5], across[5];
  };
  const Row rows[] = {{3, kFullyDeveloped, {0.83, 0.58, 0.28, 0.04, 0.00}, {0.78, 0.50, 0.22, 0.03, 0.00}},
                      {6, kFullyDeveloped, {0.90, 0.76, 0.56, 0.29, 0.11}, {0.87, 0.68, 0.45, 0.20, 0.07}},
                      {6, 20e3, {0.87, 0.68, 0.42, 0.13, 0.02}, {0.82, 0.59, 0.33, 0.09, 0.01}},
                      {10, kFullyDeveloped, {0.93, 0.83, 0.68, 0.46, 0.29}, {0.91, 0.78, 0.59, 0.34, 0.19}}};
  const double sides[] = {0.5, 1, 2, 5, 10};
  for (const Row& row : rows) {
    const ElfouhailySpectrum spectrum(row.wind_speed, row.fetch);
    const WaveCorrelation sea(WindWaves(spectrum, SeaWavenumbers()));
    const BeamCorrelation beam(sea, {.footprint = 0.6}, kRefractiveIndex);
    for (int i = 0; i < 5; ++i) {
      const PulseCorrelation found = CorrelationOf(beam.InCell({.side = sides[i]}), beam.pulse());
      const Eigen::Array2d sum = SumOverWaves(spectrum, 0.6, sides[i]);
      EXPECT_NEAR(found.slope_x, sum[0], 0.001)
          << row.wind_speed << " m/s, " << row.fetch << " m, " << sides[i] << " m";
      EXPECT_NEAR(found.slope_y, sum[1], 0.001)
          << row.wind_speed << " m/s, " << row.fetch << " m, " << sides[i] << " m";
      EXPECT_NEAR(sum[0], row.along[i], 0.0055)
          << row.wind_speed << " m/s, " << row.fetch << " m, " << sides[i] << " m";
      EXPECT_NEAR(sum[1], row.across[i], 0.0055)
          << row.wind_speed << " m/s, " << row.fetch << " m, " << sides[i] << " m";
    }
  }
}

}  // namespace
}  // namespace albtpu
