// The studies of the sea, in their quick form: the verdicts that physics predicts, agreements and differences.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "validation/studies/studies.h"

namespace albtpu {
namespace {

const StudyOptions kQuick{.published = PAPER_FOLDER, .quick = true};

bool Has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const DataTable& TableOf(const Study& study, std::string_view name) {
  const auto table =
      std::find_if(study.tables.begin(), study.tables.end(), [&](const auto& t) { return t.name == name; });
  EXPECT_NE(table, study.tables.end()) << name;
  return *table;
}

double Number(const DataTable& table, std::size_t row, const std::string& column) {
  const auto at = std::find(table.columns.begin(), table.columns.end(), column) - table.columns.begin();
  return std::get<double>(table.rows.at(row).at(at));
}

TEST(SpectrumStudy, HasThePeakOfTheLaboratoryWaves) {
  const absl::StatusOr<Study> study = SpectrumStudy(kQuick);
  const Comparison& wavelength = study->comparisons.at(0);
  EXPECT_NEAR(wavelength.ours / wavelength.published, 1, 0.2);  // the spread of Table 2 about Eq. 5
  EXPECT_EQ(study->comparisons.back().verdict, Verdict::kAgrees);
  const DataTable& spot = TableOf(*study, "figure_3_spot");
  double power = 0;
  for (std::size_t row = 0; row < spot.rows.size(); ++row) power += Number(spot, row, "power");
  // Through still water a 0.25 m beam at 15 degrees lights an ellipse, 1.05 times wider 0.25 m down; no ray is lost.
  const double lit = 3.14159265 / 4 * 0.25 * 0.25 / 0.966 * 1.05 * 1.05 / (0.003 * 0.003);
  EXPECT_NEAR(power / lit, 1, 0.02);
}

TEST(RealSeaStudy, FindsElfouhailysSlopesWithinTheScatterOfCoxAndMunkAndApelsAbove) {
  const absl::StatusOr<Study> study = RealSeaStudy(kQuick);
  int judged = 0;
  for (const Comparison& c : study->comparisons) {
    if (!Has(c.quantity, "Mean square slope")) continue;
    const bool light = Has(c.quantity, " 1 m/s") || Has(c.quantity, " 2 m/s");
    if (light) continue;
    ++judged;
    // Over all winds Elfouhaily's sea is not within the scatter, because it is too steep in light wind.
    const bool within = Has(c.quantity, "Elfouhaily") && !Has(c.quantity, "1-14 m/s");
    EXPECT_EQ(c.verdict, within ? Verdict::kAgrees : Verdict::kDiffers) << c.quantity;
  }
  EXPECT_EQ(judged, 2 * (3 * 2 + 2));
  // The ratio of the two spectra is the same in the Monte Carlo and in the closed form, except for the nonlinearity
  // of each, up to 0.3 of the mean square slopes (0.13 and 0.06 at 10 m/s).
  const DataTable& simulated = TableOf(*study, "spectra_monte_carlo");
  for (std::size_t row = 0; row < simulated.rows.size(); ++row) {
    EXPECT_NEAR(Number(simulated, row, "thu_ratio") / Number(simulated, row, "thu_ratio_closed_form"), 1,
                0.03 + 3 * Number(simulated, row, "thu_ratio_standard_error") / Number(simulated, row, "thu_ratio"))
        << row;
  }
}

TEST(CorrectedWavesStudy, AgreesBetweenMonteCarloAndClosedForm) {
  const absl::StatusOr<Study> study = CorrectedWavesStudy(kQuick);
  for (const Comparison& c : study->comparisons) EXPECT_NE(c.verdict, Verdict::kDiffers) << c.quantity;
  // The vertical bias at nadir is of second order in slope, and waves of all lengths contribute to it: it is
  // proportional to the remaining mean square slope. The next order is smaller by about that slope.
  const DataTable& simulated = TableOf(*study, "corrected_waves_monte_carlo");
  for (std::size_t row = 1; row < simulated.rows.size(); ++row) {
    const auto left = [&](const char* column) { return Number(simulated, row, column) / Number(simulated, 0, column); };
    EXPECT_NEAR(left("nadir_bias_vertical_m"), left("mean_square_slope"), Number(simulated, 0, "mean_square_slope"))
        << row;
    EXPECT_LT(left("nadir_bias_vertical_m"), 1) << row;
  }
  const DataTable& table = TableOf(*study, "corrected_waves");
  for (std::size_t row = 1; row < table.rows.size(); ++row) {
    if (table.rows[row][3] == Cell(std::string("nothing"))) continue;
    EXPECT_LE(Number(table, row, "thu_per_depth"), Number(table, row - 1, "thu_per_depth") * (1 + 1e-6)) << row;
  }
}

}  // namespace
}  // namespace albtpu
