#include "quality/report/land_table.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "budget/total/error_ellipse.h"
#include "tables/coverage.h"

namespace albtpu::quality {
namespace {

constexpr int kGround = 2, kVegetation = 5, kSurface = 41;

Specification OfRmse(double limit) {
  return {.name = "s",
          .title = "S",
          .source = "test",
          .land = true,
          .classes = {{.name = "tight", .coverage = Coverage::kOneSigma, .vertical = Limit{.constant = limit}},
                      {.name = "both",
                       .coverage = Coverage::kOneSigma,
                       .horizontal = Limit{.constant = 1},
                       .vertical = Limit{.constant = 1}}}};
}

TEST(LandTable, IsNullWithoutLand) {
  LandTable table;
  EXPECT_TRUE(table.Json({}, {}).is_null());
  table.Add({.point_class = kSurface, .of_water_surface = true, .variance_horizontal = 1, .variance_vertical = 1});
  EXPECT_TRUE(table.Json({}, {}).is_null());
}

TEST(LandTable, HasTheRootsOfTheMeanVariances) {
  LandTable table;
  table.Add({.point_class = kGround, .variance_horizontal = 0.09F, .variance_vertical = 0.01F});
  table.Add({.point_class = kVegetation, .variance_horizontal = 0.01F, .variance_vertical = 0.07F});
  table.Add({.point_class = kSurface, .of_water_surface = true, .variance_horizontal = 9, .variance_vertical = 9});
  const auto json = table.Json({}, {});
  EXPECT_EQ(json["points"], 2);
  EXPECT_EQ(json["water_surface_points"], 1);
  EXPECT_NEAR(json["rmse_horizontal"], std::sqrt(0.05), 1e-8);
  EXPECT_NEAR(json["rmse_vertical"], 0.2, 1e-8);
  EXPECT_NEAR(json["rmse_3d"], 0.3, 1e-8);
  ASSERT_EQ(json["by_class"].size(), 2);
  EXPECT_EQ(json["by_class"][1]["class"], kVegetation);
  EXPECT_NEAR(json["by_class"][1]["rmse_vertical"], std::sqrt(0.07), 1e-8);
  EXPECT_NEAR(json["sigma_horizontal"]["greatest"], 0.3, 1e-7);
}

// Errors that a line shares, errors of points of unequal variance, and check points with errors of their own: squared
// differences agree with the prediction, within 4 standard errors over the lines.
TEST(LandTable, PredictsTheDifferencesFromCheckPoints) {
  constexpr int kLines = 4000, kPoints = 20;
  constexpr double kOfLine = 0.03, kHorizontalCheck = 0.02, kVerticalCheck = 0.04;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  LandTable table;
  double horizontal = 0, horizontal_squared = 0, vertical = 0, vertical_squared = 0;
  for (int line = 0; line < kLines; ++line) {
    const double of_line[] = {kOfLine * normal(random), kOfLine * normal(random), kOfLine * normal(random)};
    double mean_horizontal = 0, mean_vertical = 0;
    for (int i = 0; i < kPoints; ++i) {
      const double sigmas[] = {0.02 + 0.01 * i, 0.05, 0.01 + 0.005 * i};
      const double check = kHorizontalCheck / std::sqrt(2);
      double differences[3];
      for (int axis = 0; axis < 3; ++axis)
        differences[axis] =
            of_line[axis] + sigmas[axis] * normal(random) - (axis == 2 ? kVerticalCheck : check) * normal(random);
      mean_horizontal += (std::pow(differences[0], 2) + std::pow(differences[1], 2)) / kPoints;
      mean_vertical += std::pow(differences[2], 2) / kPoints;
      table.Add({.point_class = kGround,
                 .variance_horizontal =
                     static_cast<float>(2 * kOfLine * kOfLine + std::pow(sigmas[0], 2) + std::pow(sigmas[1], 2)),
                 .variance_vertical = static_cast<float>(kOfLine * kOfLine + std::pow(sigmas[2], 2))});
    }
    horizontal += mean_horizontal / kLines;
    horizontal_squared += std::pow(mean_horizontal, 2) / kLines;
    vertical += mean_vertical / kLines;
    vertical_squared += std::pow(mean_vertical, 2) / kLines;
  }
  const auto json = table.Json({}, {.horizontal = kHorizontalCheck, .vertical = kVerticalCheck});
  const auto error = [](double mean, double squared) { return 4 * std::sqrt((squared - mean * mean) / kLines); };
  EXPECT_NEAR(std::pow(json["against"]["difference_horizontal"].get<double>(), 2), horizontal,
              error(horizontal, horizontal_squared));
  EXPECT_NEAR(std::pow(json["against"]["difference_vertical"].get<double>(), 2), vertical,
              error(vertical, vertical_squared));
}

TEST(LandTable, HoldsTheDifferencesAndTheErrorsOfCheckPointsAgainstClasses) {
  LandTable table;
  table.Add({.point_class = kGround, .variance_horizontal = 0.01F, .variance_vertical = 0.0016F});
  // sqrt(0.04^2 + 2 x 0.02^2) = 0.04899.
  for (const auto& [limit, met] : {std::pair{0.048, false}, {0.05, true}}) {
    const auto json = table.Json({OfRmse(limit), {.name = "of the bottom"}}, {.vertical = 0.02});
    ASSERT_EQ(json["classes"].size(), 2);
    EXPECT_EQ(json["classes"][0]["met"], met);
    EXPECT_EQ(json["classes"][1]["met"], true);
    EXPECT_TRUE(json["classes"][0]["horizontal"].is_null());
    EXPECT_NEAR(json["against"]["judged_vertical"], std::sqrt(0.0024), 1e-7);
  }
}

// Why an RMSE is not THU / 1.96 or THU / 2.4477: the radius that holds 95 % is 2.4477 / sqrt(2) = 1.7308 radial RMSE of
// a circle, 1.9600 of a line, and between them of an ellipse.
TEST(LandTable, StatesARadialRmseThatNoFactorMakesOfTheRadiusOf95Percent) {
  // 2 RadiusFactors x the root of the trace is that radius (AnnotatedPoint, HorizontalUncertainty).
  EXPECT_NEAR(2 * RadiusFactors::Get()(1), std::sqrt(-std::log(0.05)), 1e-6);
  EXPECT_NEAR(2 * RadiusFactors::Get()(0), 1.959964, 1e-6);
  EXPECT_GT(RadiusFactors::Get()(0.5), RadiusFactors::Get()(1));
  EXPECT_LT(RadiusFactors::Get()(0.5), RadiusFactors::Get()(0));
}

}  // namespace
}  // namespace albtpu::quality
