#include "validation/published/published_tables.h"

#include <gmock/gmock.h>

#include <cmath>

#include "sea/response/closed_form.h"
#include "tables/file/table_io.h"
#include "tables/query/interpolation.h"
#include "validation/published/published_table.h"

namespace albtpu {
namespace {

using ::testing::HasSubstr;

constexpr double kDegree = 0.017453292519943295;

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

}  // namespace
}  // namespace albtpu
