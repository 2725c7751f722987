// The cross-check of small blocks, 6 lines and 2 cross lines, over a sea that travels: pulses share its waves, and the
// errors of a trajectory last for whole lines. ALBTPU_EVERY_CASE=1 measures 200 blocks of each kind.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "quality/crosscheck/cross_check.h"
#include "tests/every_case.h"
#include "tests/quality/crosscheck/simulated_lines.h"
#include "tests/quality/crosscheck/travelling_sea.h"

namespace albtpu::quality {
namespace {

using testing::SimulatedLines;

const int kBlocks = albtpu::testing::EveryCase() ? 200 : 10;

SimulatedLines Block(std::uint64_t seed) {
  return {.seed = seed,
          .lines = 6,
          .cross_lines = 2,
          .length = 400,
          .line_spacing = 80,
          .swath = 50,
          .spacing = 1.25,
          .square = 30,
          .period = 30,
          .wind_speed = 6,
          .lasting = true};
}

CrossCheck CheckOf(const SimulatedLines& options, const SharedWaves& waves) {
  const std::vector<AnnotatedPoint> points = testing::Simulate(options);
  OverlapPatches patches(5, 1, Coverage::kOneSigma);
  patches.Find(points);
  patches.Choose();
  patches.Fill(points, 0);
  return CheckPatches(patches, waves).value();
}

// What is found in many blocks.
struct Found {
  int blocks = 0, pulse_holds = 0, line_holds = 0, both_hold = 0, pulse_noticed = 0, line_noticed = 0,
      pulse_differs = 0, line_differs = 0;
  double pulse = 0, air = 0, sea = 0, line = 0, degrees = 0, noise = 0, lasting = 0;
  double z_squares = 0, of_error_squares = 0, beyond_five = 0, differences = 0;
  std::map<std::string, int> named;

  void Add(const CrossCheck& check) {
    ++blocks;
    const Estimate& line_factor = check.line.factor.value();
    pulse_holds += check.pulse.factor.excludes(1) ? 0 : 1;
    line_holds += line_factor.excludes(1) ? 0 : 1;
    both_hold += check.factor.excludes(1) ? 0 : 1;
    pulse_differs += check.pulse.differs ? 1 : 0;
    line_differs += check.line.differs ? 1 : 0;
    ++named[check.guilty];
    pulse += check.pulse.factor.value, air += check.pulse.air.value, sea += check.pulse.sea.value;
    line += line_factor.value, degrees += check.line.degrees, noise += check.line.noise;
    lasting += check.line.lasting;
    for (const LineDifference& each : check.line.differences) {
      z_squares += each.z() * each.z();
      const double of_error = std::abs(each.mean) / each.standard_error;
      of_error_squares += of_error * of_error;
      beyond_five += of_error > 5 ? 1 : 0;
      ++differences;
    }
  }

  void Print(const char* what) const {
    const double n = blocks;
    std::printf(
        "%s, %d blocks: the intervals have 1 of pulses in %.1f %%, of lines in %.1f %%, of both in %.1f %%; mean "
        "factors "
        "%.3f (air %.3f, sea %.3f) and %.3f, %.1f degrees, noise %.3f, lasting %.2f\n  differ: pulses %d, lines %d; "
        "named:",
        what, blocks, 100 * pulse_holds / n, 100 * line_holds / n, 100 * both_hold / n, pulse / n, air / n, sea / n,
        line / n, degrees / n, noise / n, lasting / n, pulse_differs, line_differs);
    for (const auto& [name, count] : named) std::printf(" %s %d", name.empty() ? "none" : name.c_str(), count);
    std::printf("\n  %.0f line differences: mean square of z %.2f, in standard errors %.2f, beyond 5 %.1f %%\n",
                differences, z_squares / differences, of_error_squares / differences, 100 * beyond_five / differences);
  }
};

template <typename Change>
Found Blocks(const char* what, double declared_wind, const Change& change) {
  SharedWaves waves;
  waves.Add(testing::SeaOfWind(declared_wind));
  Found found;
  for (int seed = 1; seed <= kBlocks; ++seed) {
    SimulatedLines block = Block(static_cast<std::uint64_t>(seed));
    change(block);
    found.Add(CheckOf(block, waves));
  }
  found.Print(what);
  return found;
}

// Of `kBlocks`, with a probability of `rate` each: as many as are exceeded by three standard deviations.
double AtMost(double rate) { return rate * kBlocks + 3 * std::sqrt(rate * (1 - rate) * kBlocks); }

TEST(CrossCheckOfBlocks, HoldsWhatIsSound) {
  const Found found = Blocks("sound", 6, [](SimulatedLines&) {});
  EXPECT_LE(kBlocks - found.pulse_holds, AtMost(0.05));
  EXPECT_LE(kBlocks - found.line_holds, AtMost(0.05));
  EXPECT_LE(found.pulse_differs + found.line_differs, AtMost(0.01));
  // Differences of a block are not independent: as many as there are lines, nearly.
  EXPECT_NEAR(found.z_squares / found.differences, 1, 3 * std::sqrt(2 / (6.0 * kBlocks)));
}

// Where the heights of the waves are not seen, they are most of the sea in shallow water, and neighbours share them.
// The factor of pulses scatters by 0.025 from block to block. Taken as independent, heights make it 0.974, and the
// noise of means 1.10.
TEST(CrossCheckOfBlocks, KnowsThatHeightsOfUnseenWavesAreShared) {
  const Found found = Blocks("heights of waves unseen", 8, [](SimulatedLines& block) {
    block.wind_speed = 8;
    block.unseen_heights = true;
  });
  EXPECT_NEAR(found.pulse / kBlocks, 1, 3 * 0.025 / std::sqrt(kBlocks));
  EXPECT_LE(found.noise / kBlocks, 1.04);
  EXPECT_LE(kBlocks - found.line_holds, AtMost(0.05));
  EXPECT_LE(found.pulse_differs + found.line_differs, AtMost(0.01));
}

// Lines without errors differ by what the standard error says.
TEST(CrossCheckOfBlocks, KnowsHowCertainLineDifferencesAre) {
  const Found found =
      Blocks("without errors of the trajectory", 6, [](SimulatedLines& block) { block.trajectory = 0; });
  EXPECT_NEAR(found.of_error_squares / found.differences, 1, 3 * std::sqrt(2 / (10.0 * kBlocks)));
  EXPECT_LE(found.beyond_five, 0);
}

TEST(CrossCheckOfBlocks, NoticesATrajectory) {
  const Found found = Blocks("trajectory x 3", 6, [](SimulatedLines& block) { block.trajectory = 3; });
  EXPECT_GE(kBlocks - found.line_holds, kBlocks - AtMost(0.05));
  EXPECT_EQ(found.named.count("sea"), 0U);
}

TEST(CrossCheckOfBlocks, NoticesAScanner) {
  const Found found = Blocks("scan x 3", 6, [](SimulatedLines& block) { block.scan = 3; });
  EXPECT_GE(kBlocks - found.pulse_holds, kBlocks - AtMost(0.1));
  EXPECT_EQ(found.named.count("sea"), 0U);
}

TEST(CrossCheckOfBlocks, NoticesASea) {
  const Found found = Blocks("3 m/s declared for 6 m/s", 3, [](SimulatedLines& block) { block.declared_wind = 3; });
  EXPECT_GE(kBlocks - found.pulse_holds, kBlocks - AtMost(0.1));
  EXPECT_EQ(found.named.count("air"), 0U);
}

}  // namespace
}  // namespace albtpu::quality
