#include "budget/beams/beam_columns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "budget/beams/refracted_path.h"
#include "sea/response/closed_form.h"
#include "tests/instruction_sets.h"

namespace albtpu {
namespace {

constexpr double kPi = std::numbers::pi, kRadians = kPi / 180, kNan = std::numeric_limits<double>::quiet_NaN();

struct Point {
  double east, north, height, depth, convergence;
};

struct Beam {
  double incidence, azimuth, slant_range, water_path;
};

// The slow and obvious twin.
Beam PlainBeam(const Point& p, double index) {
  const double distance = std::hypot(p.east, p.north);
  double azimuth = std::fmod(std::atan2(p.east, p.north) + p.convergence + 4 * kPi, 2 * kPi);
  if (p.depth <= 0) {
    const double below = p.height + p.depth;
    return {std::atan2(distance, below), azimuth, std::hypot(distance, below), 0};
  }
  const double r = DistanceToWater(distance, p.height, p.depth, index);
  return {std::atan2(r, p.height), azimuth, std::hypot(r, p.height), std::hypot(distance - r, p.depth)};
}

std::vector<Point> RandomPoints(std::size_t count) {
  std::mt19937_64 random(1);
  const auto draw = [&random](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double height = draw(30, 1000), distance = height * std::tan(draw(0, 60) * kRadians);
    const double direction = draw(0, 2 * kPi);
    points.push_back(
        {distance * std::cos(direction), distance * std::sin(direction), height, draw(-20, 70), draw(-0.05, 0.05)});
  }
  return points;
}

std::vector<Beam> Compute(std::span<const Point> points, double index) {
  const auto column_of = [&points](double Point::*member) {
    std::vector<double> column;
    for (const Point& point : points) column.push_back(point.*member);
    return column;
  };
  const std::vector<double> east = column_of(&Point::east), north = column_of(&Point::north),
                            height = column_of(&Point::height), depth = column_of(&Point::depth),
                            convergence = column_of(&Point::convergence);
  const std::size_t size = points.size();
  std::vector<double> incidence(size), azimuth(size), slant_range(size), water_path(size);
  ComputeBeams({east, north, height, depth, convergence}, index, {incidence, azimuth, slant_range, water_path});
  std::vector<Beam> beams;
  for (std::size_t i = 0; i < size; ++i) beams.push_back({incidence[i], azimuth[i], slant_range[i], water_path[i]});
  return beams;
}

Beam Compute(const Point& point) { return Compute(std::span(&point, 1), kRefractiveIndex)[0]; }

void ExpectSameBits(const Beam& ours, const Beam& theirs) {
  EXPECT_EQ(ours.incidence, theirs.incidence);
  EXPECT_EQ(ours.azimuth, theirs.azimuth);
  EXPECT_EQ(ours.slant_range, theirs.slant_range);
  EXPECT_EQ(ours.water_path, theirs.water_path);
}

class BeamColumnsOn : public testing::OnInstructionSet {};

TEST_P(BeamColumnsOn, AgreeWithTheStandardLibrary) {
  const std::vector<Point> points = RandomPoints(100'000);
  for (const double index : {1.0, kRefractiveIndex, 1.5}) {
    const std::vector<Beam> beams = Compute(points, index);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Beam expected = PlainBeam(points[i], index);
      // Lengths below 4 km are rounded to 2e-13 m, half a dozen times on either side; over 30 m, that turns a beam by
      // 7e-14 rad. The azimuth is the arctangent (1e-15) and sums below 5 pi, each rounded to at most 9e-16.
      ASSERT_NEAR(beams[i].incidence, expected.incidence, 1e-13);
      ASSERT_LE(std::abs(std::remainder(beams[i].azimuth - expected.azimuth, 2 * kPi)), 4e-15);
      ASSERT_NEAR(beams[i].slant_range, expected.slant_range, 2e-12);
      ASSERT_NEAR(beams[i].water_path, expected.water_path, 2e-12);
      ASSERT_GE(beams[i].azimuth, 0);
      ASSERT_LT(beams[i].azimuth, 2 * kPi);
    }
  }
}

TEST_P(BeamColumnsOn, HaveTheSameBitsOnEveryInstructionSet) {
  const std::vector<Point> points = RandomPoints(10'000);
  const std::vector<Beam> here = Compute(points, kRefractiveIndex);
  Choose(0);
  const std::vector<Beam> elsewhere = Compute(points, kRefractiveIndex);
  for (std::size_t i = 0; i < points.size(); ++i) ExpectSameBits(here[i], elsewhere[i]);
}

TEST_P(BeamColumnsOn, DependOnTheirPointAloneNotOnItsPlace) {
  const std::vector<Point> points = RandomPoints(1000);
  const std::vector<Beam> all = Compute(points, kRefractiveIndex);
  for (const std::size_t i : {0, 1, 127, 128, 129, 999}) ExpectSameBits(Compute(points[i]), all[i]);
}

ALBTPU_ON_EACH_INSTRUCTION_SET(BeamColumnsOn);

TEST(BeamColumns, MeetTheWaterWhereThePathOfASinglePointDoes) {
  for (const Point& point : RandomPoints(1000)) {
    const double distance = std::sqrt(point.east * point.east + point.north * point.north);
    const double r = DistanceToWater(distance, point.height, point.depth, kRefractiveIndex);
    const double below = point.depth <= 0 ? point.height + point.depth : point.height;
    EXPECT_EQ(Compute(point).slant_range, std::sqrt(r * r + below * below));
  }
}

TEST(BeamColumns, ObeySnellsLaw) {
  for (const double degrees : {0.0, 5.0, 20.0, 45.0}) {
    const double theta = degrees * kRadians, in_water = StillWaterRefraction(theta, kRefractiveIndex);
    const Beam beam = Compute({0, 400 * std::tan(theta) + 12 * std::tan(in_water), 400, 12, 0});
    EXPECT_NEAR(beam.incidence, theta, 1e-14);
    EXPECT_NEAR(beam.slant_range, 400 / std::cos(theta), 1e-12);
    EXPECT_NEAR(beam.water_path, 12 / std::cos(in_water), 1e-12);
  }
}

TEST(BeamColumns, TravelClockwiseFromTrueNorth) {
  EXPECT_EQ(Compute({0, 9, 400, 1, 0}).azimuth, 0);
  EXPECT_EQ(Compute({9, 0, 400, 1, 0}).azimuth, kPi / 2);
  EXPECT_EQ(Compute({0, -9, 400, 1, 0}).azimuth, kPi);
  EXPECT_EQ(Compute({-9, 0, 400, 1, 0}).azimuth, 2 * kPi - kPi / 2);
  EXPECT_EQ(Compute({9, 0, 400, 1, 0.03}).azimuth, kPi / 2 + 0.03);
  EXPECT_EQ(Compute({-1e-300, 9, 400, 1, 0}).azimuth, 0);  // 2 pi, rounded.
  EXPECT_EQ(Compute({0, 0, 400, 1, 0}).azimuth, 0);
}

TEST(BeamColumns, ReachPointsAboveTheWaterInAStraightLine) {
  const Beam dry = Compute({300, 0, 410, -10, 0});
  EXPECT_EQ(dry.incidence, std::atan2(3, 4));
  EXPECT_EQ(dry.slant_range, 500);
  EXPECT_EQ(dry.water_path, 0);
  EXPECT_EQ(Compute({300, 0, 400, 0, 0}).slant_range, 500);
  EXPECT_EQ(Compute({300, 0, 400, -400, 0}).incidence, kPi / 2);
}

TEST(BeamColumns, AreContinuousAtTheWater) {
  const Beam above = Compute({150, 0, 400, -1e-9, 0}), below = Compute({150, 0, 400, 1e-9, 0});
  EXPECT_NEAR(above.incidence, below.incidence, 1e-11);
  EXPECT_NEAR(above.slant_range, below.slant_range, 3e-9);
}

TEST(BeamColumns, AreNotNumbersWhereTheSensorIsNotAboveTheWater) {
  for (const double height : {0.0, -5.0, kNan}) {
    for (const double depth : {-1.0, 0.0, 1.0}) {
      const Beam beam = Compute({9, 9, height, depth, 0});
      EXPECT_TRUE(std::isnan(beam.incidence) && std::isnan(beam.slant_range));
      EXPECT_TRUE(depth <= 0 || std::isnan(beam.water_path));
    }
  }
  EXPECT_TRUE(std::isnan(Compute({9, 9, 400, kNan, 0}).incidence));
  EXPECT_TRUE(std::isnan(Compute({kNan, 9, 400, 1, 0}).azimuth));
}

TEST(BeamColumns, TakeOneConvergenceForAllOrNoneAndWriteWhatIsWanted) {
  const std::vector<double> east(300, 3), north(300, 4), height(300, 400), depth(300, 5), one = {0.1};
  std::vector<double> azimuth(300);
  ComputeBeams({east, north, height, depth, one}, kRefractiveIndex, {.azimuth = azimuth});
  EXPECT_EQ(azimuth[0], Compute({3, 4, 400, 5, 0.1}).azimuth);
  EXPECT_EQ(std::count(azimuth.begin(), azimuth.end(), azimuth[0]), 300);
  ComputeBeams({east, north, height, depth}, kRefractiveIndex, {.azimuth = azimuth});
  EXPECT_EQ(azimuth[299], Compute({3, 4, 400, 5, 0}).azimuth);
}

TEST(FootprintDiameter, IsTheSlantRangeTimesTheDivergencePlusTheAperture) {
  EXPECT_EQ(FootprintDiameter(400, 1e-3), 0.4);
  EXPECT_EQ(FootprintDiameter(400, 1e-3, 0.05), 0.4 + 0.05);
}

TEST(AzimuthFromDownwind, IsZeroForABeamThatTravelsWithTheWind) {
  EXPECT_EQ(AzimuthFromDownwind(kPi, 0), 0);  // A wind from the north blows south.
  EXPECT_EQ(AzimuthFromDownwind(0, kPi), 0);
  EXPECT_EQ(AzimuthFromDownwind(0, 0), kPi);
  EXPECT_EQ(AzimuthFromDownwind(kPi / 2, kPi / 2), kPi);
  EXPECT_EQ(AzimuthFromDownwind(0, 2 * kPi), kPi);
  EXPECT_EQ(AzimuthFromDownwind(kPi, 1e-300), 0);
  EXPECT_NEAR(AzimuthFromDownwind(0.1, 1.5 * kPi), 2 * kPi + 0.1 - kPi / 2, 4e-15);  // From west: blows east.
}

}  // namespace
}  // namespace albtpu
