#include "validation/published/published_table.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/degree.h"
#include "tests/temporary_folder.h"

namespace albtpu {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class PublishedTableTest : public ::testing::Test {
 protected:
  std::filesystem::path File(const std::string& text) { return folder_.Write("table.csv", text); }
  testing::TemporaryFolder folder_;
};

TEST_F(PublishedTableTest, ReadsItsColumnsAsNumbersAndWords) {
  const auto table = PublishedTable::Read(File("# attribution\nwind_m_s,reading\n2.5,clean\n5.25,doubtful\n"));
  EXPECT_EQ(table->size(), 2);
  EXPECT_THAT(*table->Numbers("wind_m_s"), ElementsAre(2.5, 5.25));
  EXPECT_THAT(*table->Words("reading"), ElementsAre("clean", "doubtful"));
}

TEST_F(PublishedTableTest, NamesFileLineAndColumnOfAnError) {
  EXPECT_THAT(std::string(PublishedTable::Read(folder_ / "none.csv").status().message()),
              HasSubstr("none.csv: cannot be read"));
  EXPECT_THAT(std::string(PublishedTable::Read(File("a,b\n1\n")).status().message()),
              HasSubstr("line 2 has 1 cells: there are 2 columns"));
  EXPECT_THAT(std::string(PublishedTable::Read(File("a,b\n")).status().message()), HasSubstr("no rows"));
  const auto table = PublishedTable::Read(File("a,b\n1,two\n"));
  EXPECT_THAT(std::string(table->Numbers("b").status().message()),
              HasSubstr("line 2, column 'b': 'two' is not a number"));
  EXPECT_THAT(std::string(table->Words("c").status().message()), HasSubstr("no column 'c': there are a, b"));
}

using albtpu::testing::kDegree;

// 2 sigma of f(theta + delta) to second order in the variance V of delta, from the derivatives of f:
// Var f = f'^2 V + (f''^2 / 2 + f' f''') V^2.
double TwoSigmaToSecondOrder(double first, double second, double third, double variance) {
  return 2 * std::sqrt(first * first * variance + (0.5 * second * second + first * third) * variance * variance);
}

TEST(AngleMethod, FollowsTheFirstDerivativesForSmallAngles) {
  const double sigma = 1e-5;
  for (const double theta : {5 * kDegree, 15 * kDegree, 40 * kDegree}) {
    const AngleMethodUncertainty result = AngleMethod(theta, 2 * sigma);
    EXPECT_NEAR(result.thu_per_depth / (2 * sigma / std::pow(std::cos(theta), 2)), 1, 1e-8);
    EXPECT_NEAR(result.tvu_per_depth / (2 * sigma * std::tan(theta)), 1, 1e-7);  // cos(theta) (1 / cos)'
  }
}

TEST(AngleMethod, FollowsTheSecondOrderForLargerAngles) {
  const double theta = 14.9 * kDegree, sigma = 0.02;
  const double t = std::tan(theta), s = 1 / std::cos(theta);
  const AngleMethodUncertainty result = AngleMethod(theta, 2 * sigma);
  // The error of the expansion is some 10 sigma^4, 2e-6.
  EXPECT_NEAR(
      result.thu_per_depth / TwoSigmaToSecondOrder(s * s, 2 * s * s * t, 2 * s * s * (1 + 3 * t * t), sigma * sigma), 1,
      1e-5);
  EXPECT_NEAR(result.tvu_per_depth / TwoSigmaToSecondOrder(t, 1 + 2 * t * t, t * (5 + 6 * t * t), sigma * sigma), 1,
              1e-4);  // a small slope and a large curvature
}

TEST(AngleMethod, HasATvuOfSecondOrderAtNadir) {
  const double sigma = 0.01;  // 1 / cos(delta) - 1 is delta^2 / 2, whose deviation is sigma^2 / sqrt(2)
  EXPECT_NEAR(AngleMethod(0, 2 * sigma).tvu_per_depth / (std::sqrt(2.0) * sigma * sigma), 1, 1e-3);
}

TEST(AngleMethod, IsZeroInStillWater) {
  EXPECT_EQ(AngleMethod(0.3, 0).thu_per_depth, 0);
  EXPECT_EQ(AngleMethod(0.3, 0).tvu_per_depth, 0);
}

// The slow twin: the midpoint rule with a thousand points per standard deviation.
TEST(AngleMethod, AgreesWithAFineSum) {
  const double theta = 18.8 * kDegree, sigma = 2.5 * kDegree;
  double weights = 0, x = 0, xx = 0, z = 0, zz = 0;
  for (double t = -7.9995; t < 8; t += 1e-3) {
    const double w = std::exp(-t * t / 2), tangent = std::tan(theta + sigma * t),
                 secant = std::cos(theta) / std::cos(theta + sigma * t);
    weights += w, x += w * tangent, xx += w * tangent * tangent, z += w * secant, zz += w * secant * secant;
  }
  const AngleMethodUncertainty result = AngleMethod(theta, 2 * sigma);
  EXPECT_NEAR(result.thu_per_depth, 2 * std::sqrt(xx / weights - x * x / weights / weights), 1e-10);
  EXPECT_NEAR(result.tvu_per_depth, 2 * std::sqrt(zz / weights - z * z / weights / weights), 1e-10);
}

TEST(AngleMethod, ByDrawsScattersAboutTheQuadratureWithItsStandardError) {
  constexpr int kDraws = 10'000, kSamples = 200;
  const double theta = 14.9 * kDegree, angle = 5.645 * kDegree;
  const AngleMethodUncertainty exact = AngleMethod(theta, angle);
  double mean = 0, square = 0;
  for (int i = 0; i < kSamples; ++i) {
    const NormalStream stream(1, 0, i);
    const double departure = AngleMethodByDraws(theta, angle, kDraws, stream).thu_per_depth / exact.thu_per_depth - 1;
    mean += departure / kSamples;
    square += departure * departure / kSamples;
  }
  const double standard_error = 1 / std::sqrt(2.0 * kDraws);
  EXPECT_NEAR(mean, 0, 4 * standard_error / std::sqrt(kSamples));
  // The relative error of a standard deviation is 1 / sqrt(2 samples), 5 %; the tangent is not quite normal, which
  // adds 2 %.
  EXPECT_NEAR(std::sqrt(square) / standard_error, 1, 0.02 + 4 * 0.05);
}

}  // namespace
}  // namespace albtpu
