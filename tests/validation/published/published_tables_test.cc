#include "validation/published/published_tables.h"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "sea/response/closed_form.h"
#include "tables/file/table_io.h"
#include "tables/query/interpolation.h"
#include "tests/degree.h"
#include "validation/published/published_angles.h"
#include "validation/published/published_table.h"

namespace albtpu {
namespace {

using ::testing::HasSubstr;

using albtpu::testing::kDegree;

UncertaintyTable Shipped(const char* file) {
  absl::StatusOr<UncertaintyTable> table = ReadTable(std::filesystem::path(TABLES_FOLDER) / file);
  EXPECT_TRUE(table.ok()) << table.status();
  return *std::move(table);
}

PublishedAngles Table4() { return ReadTable4(PAPER_FOLDER).value(); }

Pulse AlongWind(double wind_speed, double incidence, double footprint, double depth) {
  return {.wind_speed = static_cast<float>(wind_speed),
          .incidence = static_cast<float>(incidence),
          .azimuth = 0,
          .footprint = static_cast<float>(footprint),
          .depth = static_cast<float>(depth)};
}

TEST(PublishedTables, AreShippedAsMadeByTheCode) {
  EXPECT_EQ(Shipped("birkebak2018_measured.h5").digest(), MeasuredTable(Table4())->digest());
  EXPECT_EQ(Shipped("birkebak2018_model.h5").digest(), ModelTable()->digest());
}

TEST(PublishedTables, AnswerWithTheAnglesOfTable4) {
  const UncertaintyTable table = Shipped("birkebak2018_measured.h5");
  const PublishedAngles paper = Table4();
  for (std::size_t w = 0; w < paper.wind_speeds.size(); ++w) {
    for (std::size_t i = 0; i < paper.incidences.size(); ++i) {
      const PulseUncertainty answer = Interpolate(table, AlongWind(paper.wind_speeds[w], paper.incidences[i], 0.25, 3));
      EXPECT_EQ(answer.outcome, Outcome::kInterpolated);
      EXPECT_EQ(answer[Quantity::kRefractionAlongWind], static_cast<float>(paper.At(w, i).along));
      EXPECT_EQ(answer[Quantity::kRefractionCrossWind], static_cast<float>(paper.At(w, i).cross));
    }
  }
}

TEST(PublishedTables, AnswerWithTable5) {
  const UncertaintyTable table = Shipped("birkebak2018_measured.h5");
  const PulseUncertainty at_10_m = Interpolate(table, AlongWind(5.25, 20, 0.25, 10));
  EXPECT_NEAR(at_10_m[Quantity::kThu], 1.05, 0.01);
  EXPECT_NEAR(at_10_m[Quantity::kTvu], 0.27, 0.01);
}

TEST(PublishedTables, HaveNoBiasesAndNoStandardErrors) {
  for (const char* file : {"birkebak2018_measured.h5", "birkebak2018_model.h5"}) {
    const UncertaintyTable table = Shipped(file);
    EXPECT_EQ(table.variable(Quantity::kBiasAlongBeam), nullptr);
    EXPECT_EQ(table.variable(Quantity::kBiasVertical), nullptr);
    EXPECT_TRUE(table.variable(Quantity::kThu)->standard_errors.empty());
    const PulseUncertainty answer = Interpolate(table, AlongWind(3, 12, 0.25, 5));
    EXPECT_EQ(answer.outcome, Outcome::kInterpolated);
    EXPECT_TRUE(std::isnan(answer[Quantity::kBiasVertical]));
    EXPECT_TRUE(std::isnan(answer.standard_errors[Index(Quantity::kThu)]));
  }
}

TEST(PublishedTables, DescribeThemselves) {
  for (const char* file : {"birkebak2018_measured.h5", "birkebak2018_model.h5"}) {
    const Provenance provenance = Shipped(file).provenance();
    EXPECT_THAT(provenance.title, HasSubstr("Birkebak et al. (2018)"));
    EXPECT_THAT(std::get<std::string>(provenance.attributes.at("license")), HasSubstr("CC BY 4.0"));
    EXPECT_THAT(std::get<std::string>(provenance.attributes.at("references")), HasSubstr("doi:10.3390/rs10030453"));
    EXPECT_THAT(std::get<std::string>(provenance.attributes.at("comment")), HasSubstr("ask with azimuth 0"));
    EXPECT_EQ(provenance.campaign, "");
  }
}

TEST(PublishedTables, EndWhereThePublishedNumbersEnd) {
  const UncertaintyTable measured = Shipped("birkebak2018_measured.h5"), model = Shipped("birkebak2018_model.h5");
  EXPECT_EQ(Interpolate(measured, AlongWind(3, 10, 0.5, 5)).axis, AxisId::kFootprint);
  for (const UncertaintyTable& table : {measured, model}) {
    EXPECT_EQ(Interpolate(table, AlongWind(6, 10, 0.25, 5)).axis, AxisId::kWindSpeed);
    EXPECT_EQ(Interpolate(table, AlongWind(3, 25, 0.25, 5)).axis, AxisId::kIncidence);
    EXPECT_EQ(Interpolate(table, AlongWind(3, 10, 0.25, 11)).axis, AxisId::kDepth);
    Pulse across = AlongWind(3, 10, 0.25, 5);
    across.azimuth = 90;
    EXPECT_EQ(Interpolate(table, across).axis, AxisId::kAzimuth);
  }
}

TEST(PublishedTables, FollowTheModelBetweenNodes) {
  const UncertaintyTable table = Shipped("birkebak2018_model.h5");
  for (const double wind_speed : {2.25, 3.7, 4.6}) {
    for (const double incidence : {0.5, 7.5, 19.5}) {
      for (const double footprint : {0.272, 0.77, 3.67}) {
        const double along = kPublishedAlongWind(wind_speed, incidence) * PublishedAlongWindDiameterFactor(footprint);
        const double cross = kPublishedCrossWind(wind_speed, incidence) * PublishedCrossWindDiameterFactor(footprint);
        const AngleMethodUncertainty exact = AngleMethod(StillWaterRefraction(incidence * kDegree, kRefractiveIndex),
                                                         std::hypot(along, cross) * kDegree);
        const double depth = 6.5;
        const PulseUncertainty answer = Interpolate(table, AlongWind(wind_speed, incidence, footprint, depth));
        EXPECT_NEAR(answer[Quantity::kRefractionAlongWind] / along, 1, 0.005);
        EXPECT_NEAR(answer[Quantity::kRefractionCrossWind] / cross, 1, 0.005);
        EXPECT_NEAR(answer[Quantity::kThu] / (depth * exact.thu_per_depth), 1, 0.005);
        EXPECT_NEAR(answer[Quantity::kTvu] / depth, exact.tvu_per_depth, 1e-4);
      }
    }
  }
}

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
