#include "validation/studies/studies.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "absl/strings/match.h"
#include "sea/spectra/wave_spectrum.h"
#include "sea/spectra/wind_sea.h"
#include "validation/studies/closed_form_ratio.h"
#include "validation/studies/real_sea_study.h"

namespace albtpu {
namespace {

TEST(StandardErrors, FollowTheNormalDistribution) {
  EXPECT_NEAR(StandardErrorsFor(1), 1.95996, 1e-4);    // 5 % for one
  EXPECT_NEAR(StandardErrorsFor(1000), 4.0556, 1e-3);  // 5e-5 for each
}

TEST(AllowedDeparture, GrowsWithSlopeAndIncidence) {
  EXPECT_DOUBLE_EQ(AllowedDeparture(0, 0), 0.015);
  EXPECT_DOUBLE_EQ(AllowedDeparture(0.1, 20), 0.065);
}

TEST(Excess, MeasuresTheDistanceBeyondTheBoundInStandardErrors) {
  EXPECT_NEAR(ExcessInStandardErrors({0.90, 0.01}, 0.07), 3, 1e-9);
  EXPECT_LT(ExcessInStandardErrors({0.99, 0.01}, 0.07), 0);
}

// The nonlinearity of Snell's law only lowers the ratio: above 1 the bound does not grow with slope.
TEST(Excess, AllowsOnlyTheDiscretizationErrorAboveTheClosedForm) {
  EXPECT_NEAR(ExcessInStandardErrors({1.03 + kDiscretizationError, 0.01}, 0.07), 3, 1e-9);
  EXPECT_LT(ExcessInStandardErrors({1 + kDiscretizationError / 2, 0.01}, 0.07), 0);
}

TEST(ClosedFormRatio, IsNearOneAndHasNoTvuAtNadir) {
  SeaCase sea_case;
  sea_case.sea.waves = WindSea{.wind_speed_10m = 3};
  sea_case.beams = {{.footprint = 0.5}, {.incidence = 0.35, .footprint = 0.5}};
  sea_case.depths = {5};
  const SeaCaseRatios ratios = CompareWithClosedForm(sea_case, 64, 1, 0);
  ASSERT_EQ(ratios.beams.size(), 2u);
  for (const ClosedFormRatio& beam : ratios.beams) {
    EXPECT_LE(ExcessInStandardErrors(beam.along, beam.allowed), 4);
    EXPECT_LE(ExcessInStandardErrors(beam.thu, beam.allowed), 4);
  }
  EXPECT_TRUE(std::isnan(ratios.beams[0].tvu.value));
  EXPECT_TRUE(std::isfinite(ratios.beams[1].tvu.value));
  EXPECT_GT(ratios.seen_fraction, kMinSeenFraction);
  EXPECT_LT(ratios.seen_fraction, 1);
}

// Cox and Munk fitted the total separately: 5.12e-3 instead of 3.16e-3 + 1.92e-3.
TEST(ObservedSeas, HaveSlopesAlongAndAcrossThatNearlySumToTheTotal) {
  for (const double wind : {2.0, 8.0, 14.0}) {
    const double sum = CoxMunkAlongWind(wind).mean_square + CoxMunkCrossWind(wind).mean_square;
    EXPECT_NEAR(CoxMunkTotal(wind).mean_square - sum, 0.04e-3 * WindSpeedAt(12.5, wind), 1e-12);
  }
}

// The integral of Pierson and Moskowitz's alpha g^2 / omega^5 exp(-beta (g / (U omega))^4).
TEST(ObservedSeas, HaveTheHeightOfTheSpectrumOfPiersonAndMoskowitz) {
  constexpr double kWind = 11, kStep = 1e-4;
  double variance = 0;
  for (double omega = 0.1; omega < 30; omega += kStep) {
    variance += 8.1e-3 * kGravity * kGravity / std::pow(omega, 5) *
                std::exp(-0.74 * std::pow(kGravity / (kWind * omega), 4)) * kStep;
  }
  EXPECT_NEAR(PiersonMoskowitzWaveHeight(kWind) / (4 * std::sqrt(variance)), 1, 1e-4);
  EXPECT_NEAR(PiersonMoskowitzWaveHeight(10), 2.13, 0.005);  // 0.21 U^2 / g
  EXPECT_EQ(PiersonMoskowitzWaveHeightOf(10), PiersonMoskowitzWaveHeight(WindSpeedAt(19.5, 10)));
}

TEST(ObservedSeas, GrowWithTheRootOfFetchUntilFullyDeveloped) {
  EXPECT_NEAR(JonswapWaveHeight(10, 4e3) / JonswapWaveHeight(10, 1e3), 2, 1e-12);
  EXPECT_NEAR(JonswapWaveHeight(10, 1e3), 1.6e-3 * std::sqrt(kGravity * 1e3 / 100) * 100 / kGravity, 1e-12);
  EXPECT_EQ(JonswapWaveHeight(10, 1e7), PiersonMoskowitzWaveHeightOf(10));
}

using ::testing::HasSubstr;

TEST(AngleMethodStudy, JudgesTheTwentyValuesOfTable5) {
  const absl::StatusOr<Study> study = AngleMethodStudy({.published = PAPER_FOLDER});
  int by_quadrature = 0;
  for (const Comparison& comparison : study->comparisons) {
    if (!absl::StrContains(comparison.quantity, "by quadrature")) continue;
    ++by_quadrature;
    EXPECT_EQ(comparison.verdict, Verdict::kAgrees) << comparison.quantity;
    EXPECT_NEAR(comparison.ours, comparison.published, 0.010) << comparison.quantity;
  }
  EXPECT_EQ(by_quadrature, 20);
}

TEST(AngleMethodStudy, ReportsThatTheLimitOfThePaperIsNotThatOfS44) {
  const Study study = AngleMethodStudy({.published = PAPER_FOLDER}).value();
  const Comparison& limit = study.comparisons.back();
  EXPECT_THAT(limit.quantity, HasSubstr("in S-44 itself"));
  EXPECT_EQ(limit.verdict, Verdict::kDiffers);
  EXPECT_DOUBLE_EQ(limit.ours, 5.5);
}

TEST(AngleMethodStudy, NeedsTheTablesOfThePaper) {
  const absl::Status status = AngleMethodStudy({.published = "/nowhere"}).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(status.message()), HasSubstr("/nowhere"));
}

TEST(LaboratoryStudy, NamesAMissingPublishedTable) {
  StudyOptions options;
  options.published = "nowhere";
  EXPECT_EQ(LaboratoryStudy(options).status().code(), absl::StatusCode::kNotFound);
  EXPECT_NE(std::string(LaboratoryStudy(options).status().message()).find("nowhere/table4_empirical.csv"),
            std::string::npos);
}

TEST(WaveStaffStudy, NamesAMissingPublishedTable) {
  StudyOptions options;
  options.published = "nowhere";
  EXPECT_NE(std::string(WaveStaffStudy(options).status().message()).find("nowhere/table2_wave_staff.csv"),
            std::string::npos);
}

TEST(WaveStaffStudy, ComparesEveryPublishedNumber) {
  StudyOptions options;
  options.published = PAPER_FOLDER;
  options.quick = true;
  const auto study = WaveStaffStudy(options);
  EXPECT_EQ(study->comparisons.size(), 18u);  // six fetches, three quantities
  for (const DataTable& table : study->tables) {
    ASSERT_FALSE(table.rows.empty()) << table.name;
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << table.name;
  }
}

}  // namespace
}  // namespace albtpu
