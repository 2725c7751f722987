#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "quality/report/survey_grid.h"
#include "tables/coverage.h"

namespace albtpu::quality {
namespace {

AnnotatedPoint Point(double sigma_x, double sigma_y, double sigma_z, double depth) {
  AnnotatedPoint point;
  point.has_number = true;
  point.variance_x = static_cast<float>(sigma_x * sigma_x);
  point.variance_y = static_cast<float>(sigma_y * sigma_y);
  point.variance_z = static_cast<float>(sigma_z * sigma_z);
  point.thu = static_cast<float>(2 * std::hypot(sigma_x, sigma_y));
  point.tvu = static_cast<float>(2 * sigma_z);
  point.depth = static_cast<float>(depth);
  return point;
}

std::vector<Specification> Limits(std::optional<Limit> horizontal, std::optional<Limit> vertical,
                                  Coverage coverage = Coverage::kP95) {
  return {{.name = "own", .title = "", .source = "", .classes = {{"a", coverage, horizontal, vertical}}}};
}

bool Meets(const AnnotatedPoint& point, const std::vector<Specification>& limits) {
  return ClassJudge(limits).Met(point) == 1;
}

TEST(ClassJudge, HoldsTheVerticalAgainstTheLimitAtItsCoverage) {
  const AnnotatedPoint point = Point(0, 0, 0.1, 10);
  EXPECT_TRUE(Meets(point, Limits({}, Limit{0.1961})));
  EXPECT_FALSE(Meets(point, Limits({}, Limit{0.1959})));
  EXPECT_TRUE(Meets(point, Limits({}, Limit{0.1001}, Coverage::kOneSigma)));
  EXPECT_FALSE(Meets(point, Limits({}, Limit{0.1999}, Coverage::kTwoSigma)));
  // The limit grows with the depth.
  EXPECT_TRUE(Meets(point, Limits({}, Limit{0.1, 0.017, true})));   // 0.1972
  EXPECT_FALSE(Meets(point, Limits({}, Limit{0.1, 0.016, true})));  // 0.1887
  EXPECT_TRUE(Meets(point, Limits({}, Limit{0.1, 0.0097})));        // 0.197
}

// The radius that holds 95 %: 1.96 sigma in one dimension, 2.4477 sigma of a circle.
TEST(ClassJudge, TakesTheRadiusThatHoldsNinetyFivePerCent) {
  EXPECT_TRUE(Meets(Point(0.1, 0, 0, 10), Limits(Limit{0.1961}, {})));
  EXPECT_FALSE(Meets(Point(0.1, 0, 0, 10), Limits(Limit{0.1959}, {})));
  EXPECT_TRUE(Meets(Point(0.1, 0.1, 0, 10), Limits(Limit{0.2449}, {})));
  EXPECT_FALSE(Meets(Point(0.1, 0.1, 0, 10), Limits(Limit{0.2447}, {})));
  AnnotatedPoint turned = Point(0.1, 0.1, 0, 10);
  turned.covariance_xy = 0.01F;  // In one line, 45 degrees from the axes: sigma 0.1414.
  EXPECT_TRUE(Meets(turned, Limits(Limit{0.2773}, {})));
  EXPECT_FALSE(Meets(turned, Limits(Limit{0.2771}, {})));
}

TEST(ClassJudge, AddsTheMagnitudeOfTheBias) {
  AnnotatedPoint point = Point(0, 0, 0.1, 10);
  point.bias_vertical = -0.05F;
  EXPECT_TRUE(Meets(point, Limits({}, Limit{0.2461})));
  EXPECT_FALSE(Meets(point, Limits({}, Limit{0.2459})));
  point.bias_along_beam = 0.3F;
  EXPECT_FALSE(Meets(point, Limits(Limit{0.29}, Limit{1})));
  point.has_number = false;
  EXPECT_FALSE(Meets(point, Limits(Limit{10}, Limit{10})));
}

TEST(PointTally, AddsUpPointsWithAndWithoutANumber) {
  PointTally tally, other;
  AnnotatedPoint point = Point(0.1, 0.1, 0.2, 5);
  point.tvu_air = 0.2F;
  point.tvu_sea = 0.3F;
  tally.Add(point, 1, Coverage::kTwoSigma);
  tally.Add(point, 0, Coverage::kTwoSigma);
  other.Add({}, 0, Coverage::kTwoSigma);
  tally.Merge(other);
  const nlohmann::ordered_json json = tally.Json(2);
  EXPECT_EQ(json["points"], 3);
  EXPECT_EQ(json["with_number"], 2);
  EXPECT_EQ(json["meeting"], (std::vector<int>{1, 0}));
  EXPECT_NEAR(json["tvu"]["mean"].get<double>(), 0.4, 1e-6);
  EXPECT_NEAR(json["shares_vertical"]["air"].get<double>(), 0.01 / 0.04, 1e-6);
  EXPECT_NEAR(json["shares_vertical"]["sea"].get<double>(), 0.0225 / 0.04, 1e-6);
  EXPECT_NEAR(json["shares_vertical"]["datum"].get<double>(), 1 - 0.25 - 0.5625, 1e-6);
}

TEST(DepthTallies, MergeBinsIntoBands) {
  DepthTallies tallies;
  for (const double depth : {0.5, 1.5, 1.6, 7.0, 150.0}) tallies.Add(Point(0, 0, 0.1, depth), 0, Coverage::kTwoSigma);
  const nlohmann::ordered_json bins = tallies.Json(0), bands = tallies.Json(0, {2, 10});
  ASSERT_EQ(bins.size(), 4);
  EXPECT_EQ(bins[1]["points"], 2);
  EXPECT_TRUE(bins[3]["to"].is_null());
  ASSERT_EQ(bands.size(), 3);
  EXPECT_EQ(bands[0]["points"], 3);
  EXPECT_EQ(bands[1]["from"], 2);
  EXPECT_EQ(bands[1]["to"], 10);
  EXPECT_EQ(bands[2]["from"], 10);
}

}  // namespace
}  // namespace albtpu::quality
