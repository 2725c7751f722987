#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "validation/published/published_angles.h"
#include "validation/published/published_tables.h"

namespace albtpu {
namespace {

TEST(AngleModel, IsRecoveredFromItsOwnAngles) {
  std::vector<AngleSample> samples;
  for (const double wind_speed : {2.0, 3.0, 5.25})
    for (const double incidence : {0.0, 10.0, 20.0})
      samples.push_back({wind_speed, incidence, kPublishedAlongWind(wind_speed, incidence)});
  const AngleModel fit = FitAngleModel(samples);
  EXPECT_NEAR(fit.wind_incidence, 0.003, 1e-10);
  EXPECT_NEAR(fit.wind, 0.4193, 1e-10);
  EXPECT_NEAR(fit.incidence, 0.0276, 1e-10);
  EXPECT_NEAR(fit.constant, 1.6208, 1e-10);
}

// With the coefficients as read the equations pass through the table that they summarize; with those printed, ten
// times smaller, they do not.
TEST(AngleModel, PassesThroughTable3AsReadAndNotAsPrinted) {
  const absl::StatusOr<PublishedAngles> table_3 = ReadTable3(PAPER_FOLDER);
  const AngleModel along_as_printed = {0.003, 0.4193, 0.00276, 1.6208};
  const AngleModel cross_as_printed = {-0.0009, 0.0063, -0.00281, 2.3};
  double along = 0, along_printed = 0, cross = 0, cross_printed = 0;
  for (std::size_t w = 0; w < table_3->wind_speeds.size(); ++w) {
    for (std::size_t i = 0; i < table_3->incidences.size(); ++i) {
      const double wind_speed = table_3->wind_speeds[w], incidence = table_3->incidences[i];
      const PublishedAngles::Cell& cell = table_3->At(w, i);
      along += (kPublishedAlongWind(wind_speed, incidence) - cell.along) / 30;
      along_printed += (along_as_printed(wind_speed, incidence) - cell.along) / 30;
      cross += (kPublishedCrossWind(wind_speed, incidence) - cell.cross) / 30;
      cross_printed += (cross_as_printed(wind_speed, incidence) - cell.cross) / 30;
    }
  }
  EXPECT_NEAR(along, 0, 0.03);
  EXPECT_LT(along_printed, -0.2);
  EXPECT_NEAR(cross, 0, 0.03);
  EXPECT_GT(cross_printed, 0.2);
}

TEST(AngleModel, HoldsAtTheDiameterOfItsTable) {
  EXPECT_EQ(PublishedAlongWindDiameterFactor(0.25), 1);
  EXPECT_EQ(PublishedCrossWindDiameterFactor(0.25), 1);
  EXPECT_NEAR(PublishedAlongWindDiameterFactor(4), std::pow(16, -0.641), 1e-12);
}

TEST(LineFit, GoesThroughPointsOnALine) {
  const LineFit line = FitLine({1, 2, 4}, {5, 7, 11});
  EXPECT_NEAR(line.slope, 2, 1e-12);
  EXPECT_NEAR(line.intercept, 3, 1e-12);
  EXPECT_NEAR(line.r_squared, 1, 1e-12);
  EXPECT_NEAR(line(10), 23, 1e-12);
}

TEST(LineFit, StatesTheVarianceThatItExplains) {
  const LineFit line = FitLine({0, 1, 2, 3}, {0, 1, 1, 0});  // symmetric: no slope
  EXPECT_NEAR(line.slope, 0, 1e-12);
  EXPECT_NEAR(line.r_squared, 0, 1e-12);
  EXPECT_NEAR(FitLine({0, 1, 2}, {0, 2, 1}).r_squared, 0.25, 1e-12);  // r = 1/2
}

TEST(PowerLaw, IsRecoveredFromItsOwnPoints) {
  const PowerLaw law = FitPowerLaw({0.25, 1, 4}, {0.6, 0.3, 0.15});
  EXPECT_NEAR(law.factor, 0.3, 1e-12);
  EXPECT_NEAR(law.exponent, -0.5, 1e-12);
}

}  // namespace
}  // namespace albtpu
