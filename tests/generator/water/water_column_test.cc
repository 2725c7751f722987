#include "generator/water/water_column.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace albtpu {
namespace {

const PhaseFunction kOcean = PhaseFunction::FournierForand(0.0183);

WaterColumn Column(double incidence = 0.21) {
  return {.incidence = incidence, .scattering = 2.8, .absorption = 0.25, .field_of_view = 0.3, .footprint = 0.05};
}

WaterEffort Effort(std::uint64_t seed) { return {.photons = 50'000, .pools = 6, .pairs_per_photon = 4, .seed = seed}; }

TEST(WaterColumn, IsTheSameByOtherSeedsWithinItsStandardErrors) {
  const double pulses[] = {0.0165, 0.1};
  const WaterColumnBias first = ComputeWaterColumn(kOcean, Column(), pulses, Effort(1));
  const WaterColumnBias second = ComputeWaterColumn(kOcean, Column(), pulses, Effort(2));
  const auto agree = [](const Estimate& a, const Estimate& b) {
    EXPECT_GT(a.standard_error, 0);
    EXPECT_NEAR(a.value, b.value, 4 * std::hypot(a.standard_error, b.standard_error));
  };
  for (std::size_t p = 0; p < 2; ++p) {
    ASSERT_TRUE(first.by_pulse[p] && second.by_pulse[p]);
    for (const Detector detector : kDetectors) {
      agree(first.by_pulse[p]->vertical[Index(detector)], second.by_pulse[p]->vertical[Index(detector)]);
      agree(first.by_pulse[p]->along[Index(detector)], second.by_pulse[p]->along[Index(detector)]);
    }
    EXPECT_LT(first.by_pulse[p]->vertical[Index(Detector::kPeak)].standard_error, 1e-4);
    agree(first.by_pulse[p]->stretch, second.by_pulse[p]->stretch);
  }
  agree(first.spot, second.spot);
  agree(first.energy, second.energy);
}

TEST(WaterColumn, ReportsTooDeepByPeakAndCentroid) {
  const double pulses[] = {0.05};
  const auto bias = ComputeWaterColumn(kOcean, Column(), pulses, Effort(1)).by_pulse[0];
  ASSERT_TRUE(bias.has_value());
  EXPECT_LT(bias->vertical[Index(Detector::kPeak)].value, 0);
  EXPECT_LT(bias->vertical[Index(Detector::kCentroid)].value, bias->vertical[Index(Detector::kPeak)].value);
  EXPECT_GT(bias->stretch.value, 1);
}

TEST(WaterColumn, HasNoBiasWithoutScattering) {
  const double pulses[] = {0.0165};
  WaterColumn clear = Column();
  clear.scattering = 1e-4;
  clear.absorption = 2000;
  const WaterColumnBias bias = ComputeWaterColumn(kOcean, clear, pulses, Effort(1));
  EXPECT_NEAR(bias.energy.value, 1, 1e-3);
  for (const Detector detector : kDetectors) {
    // What remains is the sampling of the footprint.
    const auto& d = *bias.by_pulse[0];
    EXPECT_NEAR(d.vertical[Index(detector)].value, 0, 3e-5 + 4 * d.vertical[Index(detector)].standard_error);
    EXPECT_NEAR(d.along[Index(detector)].value, 0, 1e-3 + 4 * d.along[Index(detector)].standard_error);
  }
}

// Seen whole, the receiver's ways delay on average as those of the beam do, at any incidence: their displacements along
// the slope of the wave front cancel.
TEST(WaterColumn, SeenWholeDelaysByTheMeanPathOfTwoPhotons) {
  for (const double incidence : {0.0, 0.35}) {
    const double depth = 1, refracted = RefractedAngle(incidence, 1.34);
    const double depths[] = {depth};
    const auto planes = WalkPhotons(kOcean, {.refracted = refracted}, depths, 200'000, 1, 0, 0);
    const EchoSetup setup{.incidence = incidence, .absorption = 1, .step = 0.001, .pairs_per_photon = 5};
    const Echo echo = PairPhotons(planes[0], planes[0], setup, 1, 0, 0);
    double weights = 0, excess = 0, total = 0, time = 0;
    for (const float e : planes[0].excess) {
      weights += std::exp(-e);
      excess += e * std::exp(-e);
    }
    for (std::size_t i = 0; i < echo.weights.size(); ++i) {
      total += echo.weights[i];
      time += echo.weights[i] * echo.TimeAt(static_cast<double>(i));
    }
    EXPECT_NEAR(echo.energy, std::pow(weights / 200'000, 2), 0.005) << incidence;
    EXPECT_NEAR(time / total, excess / weights / depth, 0.003) << incidence;
  }
}

// Every pair of some photons that go on straight to a bottom of depth 1 + tilt x, with no expansion in the tilt.
Echo OnATiltedBottom(const Crossings& photons, const EchoSetup& setup, double tilt) {
  Echo echo(setup.step);
  const double scale = 1 / photons.depth, lag = std::sin(setup.incidence) / (2 * setup.group_index);
  const auto secant = [&](std::size_t i) { return std::hypot(1.0, photons.forward[i], photons.sidelong[i]); };
  for (std::size_t i = 0; i < photons.excess.size(); ++i) {
    const double u = photons.forward[i], deeper = tilt * photons.ahead[i] * scale / (1 - tilt * u);
    const double x = photons.ahead[i] * scale + deeper * u;
    for (std::size_t j = 0; j < photons.excess.size(); ++j) {
      for (const int mirror : {-1, 1}) {
        const double y = mirror * (photons.sideways[i] * scale + deeper * photons.sidelong[i]);
        const double exit_x = x - photons.ahead[j] * scale - deeper * photons.forward[j];
        const double exit_y = y - photons.sideways[j] * scale - deeper * photons.sidelong[j];
        if (std::hypot(exit_x * std::cos(setup.incidence), exit_y) > setup.field_of_view / 2) continue;
        const double excess = (photons.excess[i] + photons.excess[j]) * scale + deeper * (secant(i) + secant(j));
        // Receivers that start evenly on the surface meet a tilted bottom as densely as this.
        const double density = 1 - tilt * photons.forward[j];
        echo.Add(excess / 2 + lag * exit_x, x, density * std::exp(-setup.absorption * photons.depth * excess), {});
      }
    }
  }
  return echo;
}

TEST(WaterColumn, AnswersToATiltAsPhotonsThatGoOnStraight) {
  const double depths[] = {2.8}, pulse = 0.2, tilt = 0.02;
  const auto planes = WalkPhotons(kOcean, {.refracted = 0.25}, depths, 1500, 1, 0, 0);
  const EchoSetup setup{.incidence = 0.34,
                        .refracted = 0.25,
                        .absorption = 0.25,
                        .field_of_view = 0.4,
                        .step = 0.005,
                        .pairs_per_photon = 2000};
  const auto level = DetectBottom(PairPhotons(planes[0], planes[0], setup, 1, 0, 0), pulse);
  const auto falls = DetectBottom(OnATiltedBottom(planes[0], setup, tilt), pulse);
  const auto rises = DetectBottom(OnATiltedBottom(planes[0], setup, -tilt), pulse);
  ASSERT_TRUE(level && falls && rises);
  for (const Detector detector : kDetectors) {
    const std::size_t d = Index(detector);
    const double seen = (falls->by[d].time - rises->by[d].time) / (2 * tilt);
    std::printf("%-9s %9.5f by tilted bottoms, %9.5f by the change of pairs\n", kDetectorNames[d].data(), seen,
                level->by[d].by_tilt);
    EXPECT_NEAR(level->by[d].by_tilt, seen, 7e-4) << kDetectorNames[d];
  }
}

TEST(WaterColumn, FindsReceiversThroughSquaresAsThroughAll) {
  const double depths[] = {2.8};
  const auto planes = WalkPhotons(kOcean, {.refracted = 0.15}, depths, 3000, 1, 0, 0);
  EchoSetup setup{.incidence = 0.2, .absorption = 0.25, .field_of_view = 0.4, .step = 0.001, .pairs_per_photon = 400};
  const Echo echo = PairPhotons(planes[0], planes[0], setup, 1, 0, 0);
  double energy = 0, ahead = 0;
  const auto& p = planes[0];
  for (std::size_t i = 0; i < p.excess.size(); ++i) {
    for (std::size_t j = 0; j < p.excess.size(); ++j) {
      for (const int mirror : {-1, 1}) {
        const double x = p.ahead[i] / 2.8, ex = x - p.ahead[j] / 2.8;
        const double ey = mirror * p.sideways[i] / 2.8 - p.sideways[j] / 2.8;
        if (std::hypot(ex * std::cos(0.2), ey) > 0.2) continue;
        const double weight = std::exp(-0.25 * (p.excess[i] + p.excess[j])) / 2;
        energy += weight;
        ahead += weight * x;
      }
    }
  }
  EXPECT_NEAR(echo.energy / (energy / 9e6), 1, 0.003);
  EXPECT_NEAR(echo.ahead - ahead / 9e6, 0, 0.003 * echo.energy);
}

}  // namespace
}  // namespace albtpu
