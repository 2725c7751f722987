#include "budget/beams/refracted_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "sea/response/closed_form.h"

namespace albtpu {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

// The slow twin: halves the tangent of the incidence in extended precision until its two ends are neighbours.
double DistanceByBisection(long double distance, long double height, long double depth, long double index) {
  long double low = 0, high = distance / height;
  for (;;) {
    const long double t = (low + high) / 2;
    if (t <= low || t >= high) return static_cast<double>(height * t);
    const long double in_water = t / std::sqrt(index * index + (index * index - 1) * t * t);
    (height * t + depth * in_water < distance ? low : high) = t;
  }
}

struct Range {
  double low, high;
};

struct Geometries {
  Range height, incidence, depth;  // m, degree, m
};

// A geometry whose incidence is known, and its distance by Snell's law.
struct Geometry {
  double distance, height, depth, index;
};

class RandomGeometries {
 public:
  explicit RandomGeometries(const Geometries& ranges) : ranges_(ranges) {}

  Geometry operator()() {
    const double height = Draw(ranges_.height), depth = Draw(ranges_.depth), index = Draw({1, 1.5});
    const double incidence = Draw(ranges_.incidence) * kRadians;
    const double in_water = std::asin(std::sin(incidence) / index);
    return {height * std::tan(incidence) + depth * std::tan(in_water), height, depth, index};
  }

 private:
  double Draw(const Range& range) { return std::uniform_real_distribution(range.low, range.high)(random_); }
  Geometries ranges_;
  std::mt19937_64 random_{1};
};

void ExpectBisection(const Geometries& ranges, int count) {
  RandomGeometries geometries(ranges);
  for (int i = 0; i < count; ++i) {
    const Geometry g = geometries();
    const double r = DistanceToWater(g.distance, g.height, g.depth, g.index);
    ASSERT_NEAR(r, DistanceByBisection(g.distance, g.height, g.depth, g.index), 1e-9)
        << g.distance << " " << g.height << " " << g.depth << " " << g.index;
    ASSERT_GE(r, 0);
    ASSERT_LE(r, g.distance);
  }
}

TEST(DistanceToWater, IsThatOfBisection) {
  ExpectBisection({.height = {30, 1000}, .incidence = {0, 60}, .depth = {0, 70}}, 300'000);
}

TEST(DistanceToWater, IsThatOfBisectionForSteeperAndDeeperBeams) {
  ExpectBisection({.height = {30, 1000}, .incidence = {0, 80}, .depth = {0, 1000}}, 100'000);
  ExpectBisection({.height = {30, 1000}, .incidence = {60, 80}, .depth = {0, 70}}, 100'000);
  ExpectBisection({.height = {30, 1000}, .incidence = {0, 60}, .depth = {0, 1e-6}}, 100'000);
  ExpectBisection({.height = {30, 31}, .incidence = {0, 80}, .depth = {900, 1000}}, 100'000);
  ExpectBisection({.height = {30, 1000}, .incidence = {0, 1e-6}, .depth = {0, 1000}}, 100'000);
}

TEST(DistanceToWater, IsRelativelyThatOfBisectionFarBeyondAnySurvey) {
  std::mt19937_64 random(3);
  const auto decades = [&random](double low, double high) {
    return std::pow(10, std::uniform_real_distribution(low, high)(random));
  };
  for (int i = 0; i < 200'000; ++i) {
    const double height = decades(0, 4), depth = decades(-6, 6), distance = decades(-6, 7);
    const double index = i % 7 == 0 ? 1 : std::uniform_real_distribution(1.0, 1.5)(random);
    ASSERT_NEAR(DistanceToWater(distance, height, depth, index) / distance,
                DistanceByBisection(distance, height, depth, index) / distance, 1e-9)
        << distance << " " << height << " " << depth << " " << index;
  }
}

TEST(DistanceToWater, ObeysSnellsLaw) {
  for (const double incidence : {1.0, 20.0, 40.0}) {
    const double theta = incidence * kRadians, in_water = StillWaterRefraction(theta, kRefractiveIndex);
    const double distance = 400 * std::tan(theta) + 15 * std::tan(in_water);
    // Distances of some 100 m are rounded to 1e-14 m, a few times.
    EXPECT_NEAR(DistanceToWater(distance, 400, 15, kRefractiveIndex), 400 * std::tan(theta), 1e-12);
  }
}

TEST(DistanceToWater, IsAStraightLineWithoutRefraction) {
  EXPECT_NEAR(DistanceToWater(150, 400, 50, 1), 150 * 400. / 450, 1e-12);
  EXPECT_EQ(DistanceToWater(150, 400, 0, 1), 150);
}

TEST(DistanceToWater, IsZeroBelowTheSensor) {
  EXPECT_EQ(DistanceToWater(0, 400, 15, kRefractiveIndex), 0);
  EXPECT_EQ(DistanceToWater(0, 400, 0, kRefractiveIndex), 0);
  EXPECT_EQ(DistanceToWater(0, 400, 15, 1), 0);
}

TEST(DistanceToWater, IsTheWholeDistanceAtAndAboveTheSurface) {
  EXPECT_EQ(DistanceToWater(150, 400, 0, kRefractiveIndex), 150);
  EXPECT_EQ(DistanceToWater(150, 400, -3, kRefractiveIndex), 150);
  EXPECT_NEAR(DistanceToWater(150, 400, 1e-9, kRefractiveIndex), 150, 1e-9);
}

TEST(DistanceToWater, StaysBetweenSensorAndPointWhateverTheNumbers) {
  for (const double distance : {0.0, 1e-300, 1.0, 1e9}) {
    for (const double height : {1e-9, 1.0, 1e9}) {
      for (const double depth : {0.0, 1e-300, 1.0, 1e12}) {
        for (const double index : {1.0, 1.0 + 1e-15, 1.33, 3.0}) {
          const double r = DistanceToWater(distance, height, depth, index);
          EXPECT_GE(r, 0);
          EXPECT_LE(r, distance);
        }
      }
    }
  }
}

}  // namespace
}  // namespace albtpu
