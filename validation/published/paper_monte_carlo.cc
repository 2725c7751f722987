#include "validation/published/paper_monte_carlo.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "validation/published/published_tables.h"

namespace albtpu {
namespace {

constexpr double kSqrt2 = std::numbers::sqrt2;
constexpr double kFigure8Incidence = 15;  // degree

}  // namespace

PaperMonteCarloSize SizeOfPaperMonteCarlo(bool quick) {
  if (quick) return {{70, std::nullopt, Estimator::kPlain}, {70, std::nullopt, Estimator::kControlVariate}};
  return {{500, 10'000, Estimator::kPlain}, {2000, std::nullopt, Estimator::kControlVariate}};
}

PaperMonteCarlo RunPaperMonteCarlo(PublishedAngles table_3, const PaperMonteCarloSize& size, std::uint64_t seed) {
  // Another seed makes the surfaces of the plain run independent of those of the fine run.
  const std::uint64_t another_seed = seed + 1;
  GridOptions grid{table_3.wind_speeds, table_3.incidences};
  PaperMonteCarlo runs{std::move(table_3), ClosedFormGrid(grid), SimulateGrid(grid, size.fine, seed), {}, {}, {}, {}};
  grid.height_scale = std::numbers::sqrt2;
  runs.fine_sqrt2 = SimulateGrid(grid, size.fine, seed);
  grid.height_scale = 1;
  runs.plain_name = absl::StrCat("plain Monte Carlo, ", size.plain.surfaces, " surfaces");
  for (const double diameter : kPaperDiameters) {
    grid.footprint = diameter;
    runs.by_diameter.push_back(SimulateGrid(grid, size.plain, another_seed));
    runs.closed_form_by_diameter.push_back(ClosedFormGrid(grid));
  }
  return runs;
}

DataTable Table3(const PaperMonteCarlo& runs) {
  DataTable table{
      .name = "table_3",
      .title = "Table 3 as printed and simulated: 2 sigma refraction, 0.25 m footprint, fully developed sea",
      .columns = {"wind_speed_m_s", "incidence_deg", "paper_along_deg", "along_reading", "closed_form_along_deg",
                  "monte_carlo_along_deg", "monte_carlo_along_se_deg", "sqrt2_monte_carlo_along_deg",
                  "sqrt2_monte_carlo_along_se_deg", "ln_sqrt2_closed_form_over_paper_along", "paper_cross_deg",
                  "cross_reading", "closed_form_cross_deg", "monte_carlo_cross_deg", "monte_carlo_cross_se_deg",
                  "sqrt2_monte_carlo_cross_deg", "sqrt2_monte_carlo_cross_se_deg",
                  "ln_sqrt2_closed_form_over_paper_cross"}};
  const auto reading = [](bool clean) { return clean ? "clean" : "doubtful"; };
  for (std::size_t w = 0; w < runs.paper.wind_speeds.size(); ++w) {
    for (std::size_t i = 0; i < runs.paper.incidences.size(); ++i) {
      const PublishedAngles::Cell& paper = runs.paper.At(w, i);
      const RefractionGrid::Cell &theory = runs.closed_form.At(w, i), &ours = runs.fine.At(w, i),
                                 &scaled = runs.fine_sqrt2.At(w, i);
      table.Add(runs.paper.wind_speeds[w], runs.paper.incidences[i], paper.along, reading(paper.along_is_clean),
                theory.along.value, ours.along, scaled.along, std::log(kSqrt2 * theory.along.value / paper.along),
                paper.cross, reading(paper.cross_is_clean), theory.cross.value, ours.cross, scaled.cross,
                std::log(kSqrt2 * theory.cross.value / paper.cross));
    }
  }
  return table;
}

DataTable LinesInWind(const PaperMonteCarlo& runs) {
  DataTable table{.name = "table_3_lines",
                  .title = "Lines fitted to the along-wind angles over wind, one for each incidence",
                  .columns = {"whose", "incidence_deg", "slope_deg_s_m", "intercept_deg", "r_squared"}};
  const auto add = [&](const char* whose, const RefractionGrid& grid) {
    const std::vector<LineFit> fits = FitAlongWindByIncidence(grid);
    for (std::size_t i = 0; i < fits.size(); ++i)
      table.Add(whose, grid.options.incidences[i], fits[i].slope, fits[i].intercept, fits[i].r_squared);
  };
  add("paper", GridOf(runs.paper));
  add("closed form", runs.closed_form);
  add("fine Monte Carlo", runs.fine);
  add("fine Monte Carlo, heights times sqrt 2", runs.fine_sqrt2);
  add(runs.plain_name.c_str(), runs.by_diameter.front());
  return table;
}

DataTable AngleModels(const PaperMonteCarlo& runs) {
  DataTable table{.name = "equations_27_28",
                  .title =
                      "Eq. 27 (along wind) and 28 (cross wind): (a theta + b) w + c theta + d in degrees, "
                      "theta in degrees, w in m/s",
                  .columns = {"axis", "whose", "a", "b", "c", "d"}};
  const auto rows = [&](const char* axis, const char* printed, const AngleModel& published, AngleAxis of) {
    const auto row = [&](const char* whose, const AngleModel& model) {
      table.Add(axis, whose, model.wind_incidence, model.wind, model.incidence, model.constant);
    };
    row(printed, published);
    row("our fit to Table 3", FitAngleModel(GridOf(runs.paper), of));
    row("our fit to our closed form", FitAngleModel(runs.closed_form, of));
    row("our fit to our Monte Carlo", FitAngleModel(runs.fine, of));
    row("our fit to our Monte Carlo, heights times sqrt 2", FitAngleModel(runs.fine_sqrt2, of));
  };
  rows("along", "printed, read with 0.0276", kPublishedAlongWind, kAlongWind);
  rows("cross", "printed, read with 0.0281", kPublishedCrossWind, kCrossWind);
  return table;
}

DataTable Figure8(const PaperMonteCarlo& runs) {
  DataTable table{
      .name = "figure_8",
      .title = "Figure 8: 2 sigma along the wind at 15 degrees, over wind, for each diameter",
      .columns = {"diameter_m", "wind_speed_m_s", "monte_carlo_deg", "monte_carlo_se_deg", "closed_form_deg",
                  "line_deg", "line_slope_deg_s_m", "line_r_squared", "equation_27_29_deg"}};
  const std::vector<double>& incidences = runs.paper.incidences;
  const auto i =
      static_cast<std::size_t>(std::find(incidences.begin(), incidences.end(), kFigure8Incidence) - incidences.begin());
  for (std::size_t d = 0; d < kPaperDiameters.size() && i < incidences.size(); ++d) {
    const LineFit line = FitAlongWindByIncidence(runs.by_diameter[d])[i];
    for (std::size_t w = 0; w < runs.paper.wind_speeds.size(); ++w) {
      const double wind_speed = runs.paper.wind_speeds[w];
      table.Add(
          kPaperDiameters[d], wind_speed, runs.by_diameter[d].At(w, i).along,
          runs.closed_form_by_diameter[d].At(w, i).along.value, line(wind_speed), line.slope, line.r_squared,
          kPublishedAlongWind(wind_speed, kFigure8Incidence) * PublishedAlongWindDiameterFactor(kPaperDiameters[d]));
    }
  }
  return table;
}

DataTable Figure9(const PaperMonteCarlo& runs) {
  DataTable table{.name = "figure_9",
                  .title = "Figure 9: 2 sigma over the diameter, mean of all winds and incidences",
                  .columns = {"diameter_m", "monte_carlo_along_deg", "monte_carlo_along_se_deg",
                              "closed_form_along_deg", "equations_along_deg", "monte_carlo_cross_deg",
                              "monte_carlo_cross_se_deg", "closed_form_cross_deg", "equations_cross_deg"}};
  for (std::size_t d = 0; d < kPaperDiameters.size(); ++d) {
    double along = 0, cross = 0;
    for (const double wind_speed : runs.paper.wind_speeds) {
      for (const double incidence : runs.paper.incidences) {
        along += kPublishedAlongWind(wind_speed, incidence) / static_cast<double>(runs.paper.cells.size());
        cross += kPublishedCrossWind(wind_speed, incidence) / static_cast<double>(runs.paper.cells.size());
      }
    }
    const RefractionGrid &ours = runs.by_diameter[d], &closed_form = runs.closed_form_by_diameter[d];
    table.Add(kPaperDiameters[d], MeanAngle(ours, kAlongWind), MeanAngle(closed_form, kAlongWind).value,
              along * PublishedAlongWindDiameterFactor(kPaperDiameters[d]), MeanAngle(ours, kCrossWind),
              MeanAngle(closed_form, kCrossWind).value, cross * PublishedCrossWindDiameterFactor(kPaperDiameters[d]));
  }
  return table;
}

}  // namespace albtpu
