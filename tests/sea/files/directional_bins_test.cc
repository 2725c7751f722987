#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sea/files/ww3_points.h"
#include "sea/spectra/wave_spreading.h"

namespace albtpu {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

std::vector<double> Directions(std::size_t count, double first) {
  std::vector<double> directions;
  for (std::size_t i = 0; i < count; ++i) directions.push_back(first + kTurn * static_cast<double>(i) / count);
  return directions;
}

// cos^2s of half the angle from 0.6 rad with s = 4 has harmonics up to 4, which 36 bins integrate exactly.
TEST(DirectionalBins, GiveTheHarmonicsOfASpreading) {
  const auto expected = Cosine2sHarmonics(4);
  for (const double first : {0.0, 0.05, -3.0, 50.0}) {
    const std::vector<double> directions = Directions(36, first);
    std::vector<double> densities;
    for (const double c : directions) densities.push_back(std::pow(std::cos((c - 0.6) / 2), 8));
    const DirectionalEnergy sum = DirectionalBins(directions).Sum(densities);
    EXPECT_NEAR(sum.energy, kTurn * 35.0 / 128, 1e-12);  // the mean of cos^8 is 35/128
    EXPECT_NEAR(sum.cosine[0] / sum.energy, expected[0] * std::cos(1.2), 1e-12);
    EXPECT_NEAR(sum.sine[0] / sum.energy, expected[0] * std::sin(1.2), 1e-12);
    EXPECT_NEAR(sum.sine[1] / sum.energy, expected[1] * std::sin(2.4), 1e-12);
    EXPECT_NEAR(sum.cosine[2], 0, 1e-12);
  }
}

TEST(DirectionalBins, MayRunEitherWay) {
  std::vector<double> directions = Directions(24, 0.1), densities;
  for (const double c : directions) densities.push_back(1 + std::cos(c - 1));
  const DirectionalEnergy forward = DirectionalBins(directions).Sum(densities);
  const DirectionalEnergy backward = DirectionalBins({directions.rbegin(), directions.rend()})
                                         .Sum(std::vector<double>(densities.rbegin(), densities.rend()));
  EXPECT_NEAR(forward.energy, backward.energy, 1e-14);
  EXPECT_NEAR(forward.cosine[0], backward.cosine[0], 1e-14);
}

TEST(DirectionalBins, AreEqualWhereDirectionsWereRounded) {
  std::vector<double> directions = Directions(36, 0.0), densities(36);
  densities[7] = 1;
  for (double& c : directions) c = std::round(c * 100) / 100;
  EXPECT_NEAR(DirectionalBins(directions).Sum(densities).energy, kTurn / 36, 1e-15);
}

// A sector of 90 degrees in steps of 5: its ends are bins like the others.
TEST(DirectionalBins, MayCoverASector) {
  std::vector<double> directions;
  for (int i = 0; i <= 18; ++i) directions.push_back(kTurn * (350 + 5 * i) / 360);
  const DirectionalEnergy sum = DirectionalBins(directions).Sum(std::vector<double>(19, 1));
  EXPECT_NEAR(sum.energy, kTurn * 95 / 360, 1e-12);
}

// The first and the last direction, 0 and 360 degrees, may be the same: each has half of the bin.
TEST(DirectionalBins, MayCloseTheCircleTwice) {
  std::vector<double> directions = Directions(36, 0.0);
  directions.push_back(kTurn);
  EXPECT_NEAR(DirectionalBins(directions).Sum(std::vector<double>(37, 1)).energy, kTurn, 1e-12);
}

TEST(DirectionalBins, KeepHarmonicsBelowAQuarterOfTheirNumber) {
  EXPECT_EQ(DirectionalBins(Directions(8, 0)).harmonics(), 1u);
  EXPECT_EQ(DirectionalBins(Directions(9, 0)).harmonics(), 2u);
  EXPECT_EQ(DirectionalBins(Directions(12, 0)).harmonics(), 2u);
  EXPECT_EQ(DirectionalBins(Directions(24, 0)).harmonics(), 5u);
  EXPECT_EQ(DirectionalBins(Directions(72, 0)).harmonics(), kSeaHarmonics);
}

}  // namespace
}  // namespace albtpu
