#include "tables/water/water_column_table.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

namespace albtpu {
namespace {

using ::testing::HasSubstr;

const std::vector<std::vector<double>> kNodes = {{0.01, 0.0175, 0.03},     {0.75, 1.5, 3, 6, 12},
                                                 {0, 4, 9, 16, 25},        {0.0625, 0.125, 0.5, 1, 2, 4},
                                                 {0.0625, 0.25, 1, 4, 16}, {0.0078125, 0.03125, 0.125, 0.5, 1.5}};

// Of the first order in the logarithm of the backscatter fraction, of the third in the other axes: what the
// interpolation must give exactly.
double Smooth(const std::vector<double>& x, bool odd) {
  const double theta = x[2] / 25;
  const double by_theta = odd ? theta - 0.4 * theta * theta * theta : 1 - 0.7 * theta * theta;
  const auto cubic = [](double u, double a, double b, double c) { return 1 + a * u + b * u * u + c * u * u * u; };
  return (1 + 0.2 * std::log(x[0] / 0.02)) * cubic(std::log(x[1] / 3), 0.3, 0.05, -0.02) * by_theta *
         cubic(std::log(x[3]), 0.1, -0.03, 0.01) * cubic(std::log(x[4]), -0.1, 0.02, 0.003) *
         cubic(std::log(x[5]), 0.2, 0.03, 0.004);
}

double ScatteringOf(const std::vector<double>& x) { return x[3] / OpticalDepthPerScattering(x[1], x[0]); }

// At one point, without the axis of pulses where the quantity has none.
double ValueAt(std::vector<double> x, std::size_t q) {
  if (!kWaterColumn.quantities[q].over_last_axis) x[5] = 1;
  switch (static_cast<WaterQuantity>(q)) {
    case WaterQuantity::kStretch:
    case WaterQuantity::kSpot:
      return 3 + 0.1 * Smooth(x, false);
    case WaterQuantity::kEnergy:
      return std::exp(-0.05 * ScatteringOf(x) * Smooth(x, false));
    default:
      return -0.01 * ScatteringOf(x) * Smooth(x, q >= 3);
  }
}

Table::Axes Axes() {
  Table::Axes axes;
  for (std::size_t i = 0; i < kNodes.size(); ++i) {
    std::vector<double> nodes = kNodes[i];
    for (double& node : nodes) node = static_cast<float>(node);
    axes.push_back(*Axis::Create(kWaterColumn.axes[i], nodes));
  }
  return axes;
}

Provenance Origin() { return {.id = "smooth", .version = "1.0", .title = "smooth", .campaign = {}, .attributes = {}}; }

Table::Variables Values() {
  const Table::Axes axes = Axes();
  Table::Variables variables;
  for (std::size_t q = 0; q < kWaterQuantityCount; ++q) {
    Variable& variable = variables.emplace_back().emplace();
    std::vector<double> x(6);
    const std::function<void(std::size_t)> fill = [&](std::size_t axis) {
      if (axis == 6) return variable.values.push_back(static_cast<float>(ValueAt(x, q)));
      if (axis == 5 && !kWaterColumn.quantities[q].over_last_axis) return fill(6);
      for (const double node : axes[axis].nodes()) {
        x[axis] = node;
        fill(axis + 1);
      }
    };
    fill(0);
  }
  return variables;
}

WaterColumnTable Smooth() {
  return *WaterColumnTable::Create(*Table::Create(kWaterColumn, Axes(), Values(), Origin()));
}

WaterBeam Beam(const std::vector<double>& x) {
  return {.incidence = x[2], .optical_depth = x[3], .field_of_view = x[4], .pulse_length = x[5]};
}

TEST(WaterColumnTable, IsExactForCubicPolynomials) {
  const WaterColumnTable table = Smooth();
  for (const std::vector<double>& x : std::vector<std::vector<double>>{{0.012, 1, 1.5, 0.1, 0.1, 0.01},
                                                                       {0.02, 4, 3.9, 0.8, 2, 0.06},
                                                                       {0.028, 11, 22, 3.7, 15, 1.2},
                                                                       {0.03, 12, 25, 4, 16, 1.5},
                                                                       {0.01, 0.75, 0, 0.0625, 0.0625, 0.0078125}}) {
    const std::optional<WaterAnswer> answer = table.Of(x[0], x[1]).At(Beam(x));
    ASSERT_TRUE(answer.has_value());
    for (std::size_t q = 0; q < kWaterQuantityCount; ++q) {
      EXPECT_NEAR((*answer)[q], ValueAt(x, q), 2e-5 * (std::abs(ValueAt(x, q)) + 0.01 * ScatteringOf(x)))
          << kWaterColumn.quantities[q].name;
    }
  }
}

TEST(WaterColumnTable, MirrorsTheBeamAtNadir) {
  const WaterColumnTable table = Smooth();
  const OneWater of_table = table.Of(0.02, 4);
  const WaterAnswer nadir = *of_table.At({.incidence = 0, .optical_depth = 1, .field_of_view = 1, .pulse_length = 0.1});
  for (const std::size_t q : {3, 4, 5}) EXPECT_NEAR(nadir[q], 0, 1e-9);
}

TEST(WaterColumnTable, IsInProportionToScatteringInTheShallowsAndHoldsWhatIsWide) {
  const WaterColumnTable table = Smooth();
  const OneWater water = table.Of(0.02, 4);
  WaterBeam beam{.incidence = 10, .optical_depth = 0.0625, .field_of_view = 16, .pulse_length = 1.5};
  const WaterAnswer first = *water.At(beam);
  beam.optical_depth /= 8;
  beam.field_of_view = std::numeric_limits<double>::infinity();
  beam.pulse_length = 100;
  const WaterAnswer shallow = *water.At(beam);
  for (std::size_t q = 0; q < 6; ++q) EXPECT_NEAR(shallow[q], first[q] / 8, 1e-9);
  EXPECT_NEAR(std::log(shallow[8]), std::log(first[8]) / 8, 1e-7);
  EXPECT_EQ(water.At({.incidence = 0, .optical_depth = 0, .field_of_view = 1, .pulse_length = 1}).value()[0], 0);
}

TEST(WaterColumnTable, AnswersNothingBeyond) {
  const WaterColumnTable table = Smooth();
  const OneWater water = table.Of(0.02, 4);
  const WaterBeam inside{.incidence = 10, .optical_depth = 1, .field_of_view = 1, .pulse_length = 0.1};
  ASSERT_TRUE(water.At(inside).has_value());
  for (const auto& [coordinate, x] : {std::pair(&WaterBeam::incidence, -1.0),
                                      {&WaterBeam::incidence, 25.1},
                                      {&WaterBeam::incidence, std::nan("")},
                                      {&WaterBeam::optical_depth, -0.1},
                                      {&WaterBeam::optical_depth, 4.01},
                                      {&WaterBeam::optical_depth, std::nan("")},
                                      {&WaterBeam::field_of_view, 0.06},
                                      {&WaterBeam::field_of_view, std::nan("")},
                                      {&WaterBeam::pulse_length, 0.0},
                                      {&WaterBeam::pulse_length, 0.007},
                                      {&WaterBeam::pulse_length, std::nan("")}}) {
    WaterBeam beam = inside;
    beam.*coordinate = x;
    EXPECT_FALSE(water.At(beam).has_value()) << x;
  }
}

TEST(WaterColumnTable, NeedsAllQuantitiesAndLight) {
  const auto problem = [](const Table::Variables& variables, const Table::Axes& axes = Axes()) {
    return std::string(
        WaterColumnTable::Create(*Table::Create(kWaterColumn, axes, variables, Origin())).status().message());
  };
  Table::Variables incomplete = Values(), dark = Values();
  incomplete[1].reset();
  dark[8]->values[3] = 0;
  EXPECT_THAT(problem(incomplete), HasSubstr("bias_vertical_half"));
  EXPECT_THAT(problem(dark), HasSubstr("energy"));

  Table::Axes shallow = Axes();
  std::vector<double> depths = shallow[Index(WaterAxis::kOpticalDepth)].nodes();
  depths.front() = 0x1p-120;
  shallow[Index(WaterAxis::kOpticalDepth)] =
      *Axis::Create(kWaterColumn.axes[Index(WaterAxis::kOpticalDepth)], depths, Scale::kLinear);
  EXPECT_THAT(problem(Values(), shallow),
              HasSubstr("'bias_vertical_peak' is beyond 1e+06 for each time that light is scattered"));

  Table::Axes uneven = Axes();
  uneven[Index(WaterAxis::kIncidence)] =
      *Axis::Create(kWaterColumn.axes[Index(WaterAxis::kIncidence)], {0, 4, 4.00390625, 16, 25});
  EXPECT_THAT(problem(Values(), uneven), HasSubstr("axis 'incidence' has nodes at 4 and 4.00391, which are too close"));

  // Answered with the first node below it.
  Table::Axes oblique = Axes();
  oblique[Index(WaterAxis::kIncidence)] =
      *Axis::Create(kWaterColumn.axes[Index(WaterAxis::kIncidence)], {10, 12, 14, 16, 25});
  EXPECT_THAT(
      problem(Values(), oblique),
      HasSubstr("axis 'incidence' begins at 10 degrees; a table of the water column begins at 0, the vertical"));
}

}  // namespace
}  // namespace albtpu
