#include "quality/report/limit_margins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "quality/report/survey_grid.h"

namespace albtpu::quality {
namespace {

TEST(LimitMargins, CountsThePointsThatAFactorLeavesWithinALimit) {
  std::mt19937 random(2);
  std::lognormal_distribution<double> margins(0, 1);
  std::vector<double> all;
  LimitMargins counted;
  for (int i = 0; i < 20'000; ++i) counted.Add(all.emplace_back(margins(random)));
  for (const double factor : {0.5, 0.9, 1.0, 1.19, 3.0}) {
    const auto within = [&](double least) {
      return static_cast<std::uint64_t>(std::ranges::count_if(all, [&](double m) { return m >= least; }));
    };
    EXPECT_LE(counted.Within(factor), within(factor));
    EXPECT_GE(counted.Within(factor), within(1.003 * factor));
  }
  EXPECT_EQ(LimitMargins().Within(1), 0);
}

// A point meets a class exactly as long as all its standard deviations, multiplied, do.
TEST(ClassJudge, MarginIsTheFactorAtWhichAPointNoLongerMeets) {
  const std::vector<Specification> specifications = {
      {.name = "s",
       .title = "S",
       .classes = {{.name = "both",
                    .coverage = Coverage::kP95,
                    .horizontal = Limit{.constant = 2},
                    .vertical = Limit{.constant = 0.5, .of_depth = 0.013, .rss = true}}}}};
  const ClassJudge judge(specifications);
  AnnotatedPoint point;
  point.has_number = true;
  point.depth = 8;
  point.bias_vertical = -0.1F;
  point.bias_along_beam = 0.3F;
  for (const float horizontal : {0.01F, 0.4F}) {
    point.variance_x = horizontal, point.variance_y = 2 * horizontal, point.covariance_xy = 0.3F * horizontal;
    point.variance_z = 0.01F;
    const double margin = judge.Margin(point, 0);
    for (const double factor : {0.99 * margin, 1.01 * margin}) {
      AnnotatedPoint scaled = point;
      for (float AnnotatedPoint::*variance : {&AnnotatedPoint::variance_x, &AnnotatedPoint::variance_y,
                                              &AnnotatedPoint::variance_z, &AnnotatedPoint::covariance_xy})
        scaled.*variance *= static_cast<float>(factor * factor);
      EXPECT_EQ(judge.Met(scaled) == 1, factor < margin) << horizontal << " " << factor;
    }
  }
  point.bias_vertical = 1;
  EXPECT_EQ(judge.Margin(point, 0), 0);
}

}  // namespace
}  // namespace albtpu::quality
