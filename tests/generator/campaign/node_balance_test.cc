#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "generator/campaign/table_maker.h"

namespace albtpu {
namespace {

UncertaintyTable::Axes Axes(const std::vector<double>& winds, const std::vector<double>& footprints) {
  return {*Axis::Create(AxisId::kWindSpeed, winds),      *Axis::Create(AxisId::kFetch, {1e5}),
          *Axis::Create(AxisId::kIncidence, {0}),        *Axis::Create(AxisId::kAzimuth, {0}),
          *Axis::Create(AxisId::kFootprint, footprints), *Axis::Create(AxisId::kDepth, {0, 10})};
}

TEST(NodeBalance, DoesNotChangeValuesLinearInTheScaleOfEachAxis) {
  const UncertaintyTable::Axes axes = Axes({1, 2, 4, 5}, {0.5, 1, 3});
  std::vector<float> values;
  for (const double wind : axes[0].nodes()) {
    for (const double footprint : axes[4].nodes())
      for (const double depth : {0.0, 10.0})
        values.push_back(static_cast<float>(20 + 3 * wind - 2 * std::log(footprint) + depth));
  }
  std::vector<float> balanced = values;
  BalanceNodes(axes, Quantity::kThu, balanced);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(balanced[i], values[i], 1e-5) << i;
}

// x^2 on a uniform grid: at the distance t from the middle of an interval, interpolation errs by h^2 / 4 - t^2, with
// the mean h^2 / 6. The root mean square error is h^2 sqrt(1 / 30) before and h^2 sqrt(1 / 180) without the mean.
TEST(NodeBalance, RemovesTheMeanError) {
  const std::vector<double> x = {2, 3, 4, 5, 6, 7};
  const UncertaintyTable::Axes axes = Axes(x, {1});
  std::vector<float> values;
  for (const double wind : x)
    for (int depth = 0; depth < 2; ++depth) values.push_back(static_cast<float>(wind * wind));
  BalanceNodes(axes, Quantity::kThu, values);
  double sum = 0, squares = 0;
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) / kSteps;
    const double error = (1 - t) * values[4] + t * values[6] - std::pow(4 + t, 2);
    sum += error / kSteps;
    squares += error * error / kSteps;
  }
  EXPECT_NEAR(sum, 0, 1e-5);
  EXPECT_NEAR(std::sqrt(squares), std::sqrt(1 / 180.0), 1e-5);
  EXPECT_EQ(values[0], 4);  // the ends do not change
  EXPECT_EQ(values[10], 49);
}

// Between a calm and the first wind, the curve is not that of the winds above.
TEST(NodeBalance, KeepsTheFirstWindAboveACalm) {
  const UncertaintyTable::Axes axes = Axes({0, 2, 3, 4}, {1});
  std::vector<float> values = {0, 0, 8, 8, 27, 27, 64, 64};
  const std::vector<float> exact = values;
  BalanceNodes(axes, Quantity::kThu, values);
  for (const int i : {0, 2, 6}) EXPECT_EQ(values[i], exact[i]);
  EXPECT_LT(values[4], exact[4]);
}

TEST(NodeBalance, KeepsAtLeastHalfOfAQuantityThatCannotBeNegative) {
  const UncertaintyTable::Axes axes = Axes({1, 2, 3}, {1});
  std::vector<float> thu = {100, 100, 0.1f, 0.1f, 100, 100}, bias = thu;
  BalanceNodes(axes, Quantity::kThu, thu);
  EXPECT_FLOAT_EQ(thu[2], 0.05f);
  BalanceNodes(axes, Quantity::kBiasVertical, bias);
  EXPECT_LT(bias[2], 0);
}

}  // namespace
}  // namespace albtpu
