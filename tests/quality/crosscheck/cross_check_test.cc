#include "quality/crosscheck/cross_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "sea/correlation/correlated_pulses.h"
#include "sea/sea_state.h"

namespace albtpu::quality {
namespace {

// Pairs of 12 lines with normal differences, whose predicted variances are a part of the true ones.
struct Truth {
  double air = 1, sea = 1, line = 1;  // Factors of the true standard deviations.
  double rough = 0;                   // m in a metre of distance.
  double offset = 0;                  // m, of line 1.
  std::uint64_t seed = 5;
};

PatchPairs Pairs(const Truth& truth) {
  constexpr double kLineSigma = 0.02;
  std::mt19937_64 random(truth.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::array<double, 13> of_lines = {};
  for (double& each : of_lines) each = truth.line * kLineSigma * normal(random);
  of_lines[1] += truth.offset;
  PatchPairs pairs;
  for (int i = 0; i < 40'000; ++i) {
    CrossPair& pair = pairs.across.emplace_back();
    pair.line_a = static_cast<std::uint16_t>(1 + i % 11);
    pair.line_b = static_cast<std::uint16_t>(pair.line_a + 1);
    pair.x = 6000 * uniform(random);
    pair.depth = static_cast<float>(20 * uniform(random));
    pair.incidence = 20;
    for (PairedPoint* const point : {&pair.a, &pair.b}) {
      point->pulse.sea = 0;
      point->variance_air = 0.005F;
      point->variance_sea = 0.0001F * pair.depth * pair.depth;
      point->variance_line = static_cast<float>(kLineSigma * kLineSigma);
    }
    pair.distance = static_cast<float>(2 * uniform(random));
    pair.difference = static_cast<float>(std::sqrt(std::pow(truth.air, 2) * pair.variance_air() +
                                                   std::pow(truth.sea, 2) * pair.variance_sea() +
                                                   std::pow(truth.rough * pair.distance, 2)) *
                                             normal(random) +
                                         of_lines[pair.line_a] - of_lines[pair.line_b]);
  }
  return pairs;
}

// Of waves that pulses do not share.
SharedWaves Apart() {
  SharedWaves waves;
  waves.Add({.spectrum = FlatSea(SeaWavenumbers(), 1)});
  return waves;
}

CrossCheck CheckOf(PatchPairs pairs) { return CheckPairs(pairs, 5, Apart()).value(); }
CrossCheck CheckOf(const Truth& truth) { return CheckOf(Pairs(truth)); }

TEST(CrossCheck, OfARightPredictionIsOne) {
  const CrossCheck check = CheckOf(Truth{});
  EXPECT_NEAR(check.chi_square, 1, 0.03);
  EXPECT_NEAR(check.pulse.factor.value, 1, 4 / std::sqrt(2 * 40'000.0));
  EXPECT_NEAR(check.median_factor, 1, 0.02);
  EXPECT_NEAR(check.beyond_three_sigma, 0.0027, 0.001);
  EXPECT_EQ(check.guilty, "");
  EXPECT_EQ(check.pulse.rough, 0);
}

// More than 3 of 20 have a probability of 1.6 %.
TEST(CrossCheck, HasIntervalsThatHoldARightPrediction) {
  int pulse = 0, line = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const CrossCheck check = CheckOf({.seed = seed});
    pulse += check.pulse.factor.excludes(1) ? 1 : 0;
    line += check.line.factor->excludes(1) ? 1 : 0;
  }
  EXPECT_LE(pulse, 3);
  EXPECT_LE(line, 3);
}

TEST(CrossCheck, TellsAirAndSeaApart) {
  const CrossCheck air = CheckOf({.air = 2});
  EXPECT_NEAR(air.pulse.air.value, 2, 0.1);
  EXPECT_NEAR(air.pulse.sea.value, 1, 0.05);
  EXPECT_EQ(air.guilty, "air");
  const CrossCheck sea = CheckOf({.sea = 0.5});
  EXPECT_NEAR(sea.pulse.sea.value, 0.5, 0.1);
  EXPECT_NEAR(sea.pulse.air.value, 1, 0.05);
  EXPECT_EQ(sea.guilty, "sea");
}

TEST(CrossCheck, NamesNeitherAirNorSeaWhereTheSeaIsNotKnown) {
  PatchPairs pairs = Pairs({.air = 2});
  for (CrossPair& pair : pairs.across) pair.a.pulse.sea = pair.b.pulse.sea = PulseOnWater::kNoSea;
  const CrossCheck check = CheckOf(std::move(pairs));
  EXPECT_EQ(check.guilty, "pulse");
  EXPECT_THAT(CrossCheckText(check), ::testing::HasSubstr("cannot tell without the sea"));
}

TEST(CrossCheck, TellsLinesFromPulses) {
  const CrossCheck check = CheckOf({.line = 4});
  EXPECT_TRUE(check.line.differs);
  EXPECT_GT(check.line.factor->low, 1.5);
  EXPECT_NEAR(check.pulse.factor.value, 1, 0.02);
  EXPECT_EQ(check.guilty, "trajectory");
}

TEST(CrossCheck, SaysThatNoErrorOfLinesShowsInsteadOfAFactorOfNothing) {
  int without = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const CrossCheck check = CheckOf({.line = 0, .seed = seed});
    const bool shows = check.line.factor->value >= 0.005;
    without += shows ? 0 : 1;
    const auto said = ::testing::ContainsRegex("of lines, .*0: no such error shows \\(95 %: at most 0\\.[0-9]+\\)");
    if (shows)
      EXPECT_THAT(CrossCheckText(check), ::testing::Not(said));
    else
      EXPECT_THAT(CrossCheckText(check), said);
    EXPECT_THAT(CrossCheckText(check), ::testing::Not(::testing::HasSubstr(" 0.00 (")));
  }
  EXPECT_GT(without, 0);  // Of 8 surveys, all have one with a probability of 0.4 %.
}

TEST(CrossCheck, LeavesOutTheRoughnessOfTheBottom) {
  const CrossCheck check = CheckOf({.rough = 0.08});
  EXPECT_NEAR(std::sqrt(check.pulse.rough), 0.08, 0.02);
  EXPECT_NEAR(check.chi_square, 1, 0.06);
}

TEST(CrossCheck, FindsALineThatLiesAbove) {
  const LineDifference line = CheckOf({.offset = 0.2}).line.differences.front();
  EXPECT_EQ(line.line_a, 1);
  EXPECT_NEAR(line.mean, 0.2, 0.1);
  EXPECT_NEAR(line.standard_error, std::sqrt(0.037 / 3636), 0.001);  // Of so many independent pairs.
  EXPECT_NEAR(line.predicted, 0.02 * std::sqrt(2), 0.001);
}

TEST(CrossCheck, NamesNoStandardErrorOfNothing) {
  CrossCheck check = CheckOf({.offset = 0.2});
  for (const auto& [error, text] : {std::pair(0.0006, "standard error 0.001 m"), {0.0004, "standard error 0.0004 m"}}) {
    check.line.differences.front().standard_error = error;
    EXPECT_THAT(CrossCheckText(check), ::testing::HasSubstr(text));
  }
}

TEST(CrossCheck, LeavesOutFewOutliersAndSaysSo) {
  PatchPairs pairs = Pairs({});
  for (int i = 0; i < 30; ++i) pairs.across[static_cast<std::size_t>(i * 1000)].difference = 5;  // Fish.
  const CrossCheck check = CheckOf(std::move(pairs));
  EXPECT_EQ(check.outliers, 30U);
  EXPECT_NEAR(check.chi_square, 1, 0.03);
}

TEST(CrossCheck, HasNoIntervalFromOnePlace) {
  PatchPairs pairs = Pairs({.air = 2});
  for (CrossPair& pair : pairs.across) pair.line_a = 1, pair.line_b = 2, pair.x = 0;
  pairs.across.resize(2000);
  const CrossCheck check = CheckOf(std::move(pairs));
  EXPECT_FALSE(check.pulse.factor.excludes(1));
  EXPECT_FALSE(check.pulse.differs);
  EXPECT_TRUE(CrossCheckJson(check)["factor_pulse"]["low"].is_null());
  EXPECT_THAT(CrossCheckText(check), ::testing::HasSubstr("gives no interval"));
}

TEST(CrossCheck, NeedsPairs) {
  PatchPairs none;
  EXPECT_FALSE(CheckPairs(none, 5, Apart()).has_value());
  PatchPairs one = {.across = {Pairs({}).across[0]}, .within = {}};
  const CrossCheck check = CheckOf(std::move(one));
  EXPECT_EQ(check.pairs, 1U);
  EXPECT_TRUE(CrossCheckJson(check)["factor_pulse"]["value"].is_null());
  EXPECT_THAT(CrossCheckText(check), ::testing::HasSubstr("too few pairs"));
}

// The slow twin: the correlation of what waves do to two pulses, without tables (correlated_pulses.h).
TEST(SharedWaves, AreThoseOfCorrelatedPulses) {
  const WindSea wind{.wind_speed_10m = 6, .fetch = 20'000, .model = &kElfouhailyModel};
  const HarmonicSpectrum sea = Sampled(*wind.MakeSpectrum(), SeaWavenumbers(), kSeaHarmonics);
  SharedWaves waves;
  waves.Add({.spectrum = sea, .x_azimuth = std::numbers::pi / 2, .water_index = 1.34});  // x is east.
  for (const double azimuth : {0.0, 60.0, 90.0}) {
    const CorrelatedPulses slow(sea, {.incidence = 20 * std::numbers::pi / 180,
                                      .azimuth = std::numbers::pi / 2 - azimuth * std::numbers::pi / 180,
                                      .footprint = 0.5});
    for (const auto& [x, y, later] :
         {std::tuple{0.0, 0.0, 0.0}, {0.5, 0.25, 0.0}, {2.0, 3.0, 0.1}, {8.0, 0.0, 0.4}, {20.0, 0.0, 1.7}}) {
      const PointOfBeam at{.depth = 5, .incidence = 20, .azimuth = azimuth, .footprint = 0.5};
      PointOfBeam other = at;
      other.x = x, other.y = y;
      const SeaParts shared = waves(PulseOnWater::Of(at, 100, 0), PulseOnWater::Of(other, 100 + later, 0));
      const PulseCorrelation twin = slow.Between(x, y, later);
      EXPECT_NEAR(shared.slopes, twin.vertical, 0.03) << azimuth << " " << x << " " << later;
      EXPECT_NEAR(shared.heights, twin.height, 0.02) << azimuth << " " << x << " " << later;
    }
  }
  const PointOfBeam at{.incidence = 20, .footprint = 0.5};
  for (const PulseOnWater& other : {PulseOnWater::Of(at, 100, 1), PulseOnWater::Of(at, 130, 0)}) {
    const SeaParts shared = waves(PulseOnWater::Of(at, 100, 0), other);
    EXPECT_EQ(std::max(std::abs(shared.slopes), std::abs(shared.heights)), 0);
  }
}

// Near the shore most of the sea's share is the height of waves that nobody saw. It is shared by points that share
// nothing of slopes.
TEST(SharedWaves, HaveTheHeightsOfUnseenWaves) {
  const WindSea wind{.wind_speed_10m = 8, .model = &kElfouhailyModel};
  const HarmonicSpectrum sea = Sampled(*wind.MakeSpectrum(), SeaWavenumbers(), kSeaHarmonics);
  SharedWaves waves;
  waves.Add({.spectrum = sea, .x_azimuth = std::numbers::pi / 2, .water_index = 1.34});
  const PointOfBeam at{.depth = 0.01, .incidence = 20, .footprint = 0.5};
  PointOfBeam far = at;
  far.x = 5;
  const double squared_depth = at.depth * at.depth;
  const SeaParts shallow = PartsOfSea(0.01, squared_depth, waves.At(at, 0)),
                 unknown = PartsOfSea(0.01, squared_depth, waves.At(at, PulseOnWater::kNoSea));
  EXPECT_NEAR(shallow.heights, 0.01, 1e-6);
  EXPECT_EQ(unknown.heights, 0);
  const std::uint16_t calm = waves.Add({.spectrum = FlatSea(SeaWavenumbers(), 1), .water_index = 1.34});
  EXPECT_EQ(PartsOfSea(0, squared_depth, waves.At(at, calm)).heights, 0);
  EXPECT_EQ(waves.At({.incidence = NAN}, 0).pulse.height, 0);
  EXPECT_EQ(unknown.slopes, 0.01);
  PairedPoint a{.pulse = PulseOnWater::Of(at, 100, 0), .variance_sea = 0.01F, .variance_heights = 0.01F};
  PairedPoint b = a;
  b.pulse = PulseOnWater::Of(far, 100, 0);
  const CorrelatedPulses slow(sea, {.incidence = 20 * std::numbers::pi / 180, .footprint = 0.5});
  const double height = slow.Between(5, 0, 0).height;
  EXPECT_GT(height, 0.5);
  EXPECT_NEAR(CovarianceOfSea(a, b, waves), 0.01 * height, 1e-4);
  a.variance_heights = b.variance_heights = 0;
  EXPECT_LT(CovarianceOfSea(a, b, waves), 0.002);
}

}  // namespace
}  // namespace albtpu::quality
