#include "generator/validation/paper_monte_carlo_study.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "generator/validation/published_angles.h"
#include "generator/validation/published_model.h"
#include "generator/validation/refraction_grid.h"

namespace albtpu {
namespace {

constexpr double kSqrt2 = std::numbers::sqrt2;
const std::vector<double> kDiameters = {0.25, 0.5, 1, 2, 4};  // m, Table 1
constexpr double kFigure8Incidence = 15;                      // degree

// The paper's own size, by tracing alone as the paper does it (section 2.1.2), and a finer one.
const SimulationSize kPaperRun = {500, 10'000, Estimator::kPlain};
const SimulationSize kQuickPaperRun = {150, std::nullopt, Estimator::kPlain};
const SimulationSize kFineRun = {2000, std::nullopt, Estimator::kControlVariate};
const SimulationSize kQuickFineRun = {200, std::nullopt, Estimator::kControlVariate};
constexpr double kFineStandardError =
    0.008;  // relative: what the fine run must reach to be judged by its own limit

// What agreement means, as rms of ln(sqrt 2 ours / paper) over the clean cells: the 500 surfaces of the paper
// scatter by 3.2 %, its trend in wind departs from ours by some 6 %, and simulated angles may add 4 % of
// nonlinearity and chance. A slope variance that is wrong by a quarter misses it.
constexpr double kClosedFormRms = 0.08, kMonteCarloRms = 0.12;
// Of a line through six winds: the theory bends; 0.8 % of noise takes 0.002 more, 3.2 % some 0.03 in the
// mean, and the lowest of five 0.1.
constexpr double kClosedFormRSquared = 0.97, kFineRSquared = 0.95, kPaperRSquared = 0.80;

struct Runs {
  PublishedAngles paper;
  RefractionGrid closed_form;       // at 0.25 m, as the next two
  RefractionGrid fine, fine_sqrt2;  // as it is, and with all heights times sqrt 2
  std::vector<RefractionGrid> by_diameter, closed_form_by_diameter;  // of the paper's size
};

Runs RunAll(PublishedAngles paper, const StudyOptions& options) {
  GridOptions grid{paper.wind_speeds, paper.incidences};
  const SimulationSize fine = options.quick ? kQuickFineRun : kFineRun;
  const SimulationSize as_paper = options.quick ? kQuickPaperRun : kPaperRun;
  // A seed of its own keeps the surfaces of the paper's size apart from those of the fine run.
  const std::uint64_t another_seed = options.seed + 1;
  Runs runs{std::move(paper), ClosedFormGrid(grid), SimulateGrid(grid, fine, options.seed), {}, {}, {}};
  grid.height_scale = kSqrt2;
  runs.fine_sqrt2 = SimulateGrid(grid, fine, options.seed);
  grid.height_scale = 1;
  for (const double diameter : kDiameters) {
    grid.footprint = diameter;
    runs.by_diameter.push_back(SimulateGrid(grid, as_paper, another_seed));
    runs.closed_form_by_diameter.push_back(ClosedFormGrid(grid));
  }
  return runs;
}

double LowestRSquared(const RefractionGrid& grid) {
  double lowest = 1;
  for (const LineFit& fit : FitAlongWindByIncidence(grid)) lowest = std::min(lowest, fit.r_squared);
  return lowest;
}

// The mean over all winds and incidences, as Figure 9 takes it. The incidences of a wind share their
// surfaces, so their errors are taken as one.
Estimate MeanOf(const RefractionGrid& grid, Estimate RefractionGrid::Cell::*axis) {
  Estimate mean;
  double variance = 0;
  const double winds = static_cast<double>(grid.options.wind_speeds.size());
  const double incidences = static_cast<double>(grid.options.incidences.size());
  for (std::size_t w = 0; w < grid.options.wind_speeds.size(); ++w) {
    double error = 0;
    for (std::size_t i = 0; i < grid.options.incidences.size(); ++i) {
      mean.value += (grid.At(w, i).*axis).value / (winds * incidences);
      error += (grid.At(w, i).*axis).standard_error / incidences;
    }
    variance += error * error / (winds * winds);
  }
  mean.standard_error = std::sqrt(variance);
  return mean;
}

PowerLaw FallWithDiameter(const std::vector<RefractionGrid>& grids, Estimate RefractionGrid::Cell::*axis) {
  std::vector<double> means;
  for (const RefractionGrid& grid : grids) means.push_back(MeanOf(grid, axis).value);
  return FitPowerLaw(kDiameters, means);
}

Verdict Agrees(bool agrees) { return agrees ? Verdict::kAgrees : Verdict::kDiffers; }

void CompareTable3(const Runs& runs, Study& study) {
  const LogRatio plain = AlongWindLogRatio(runs.closed_form, 1, runs.paper);
  const LogRatio closed_form = AlongWindLogRatio(runs.closed_form, kSqrt2, runs.paper);
  const LogRatio monte_carlo = AlongWindLogRatio(runs.fine, kSqrt2, runs.paper);
  const LogRatio scaled = AlongWindLogRatio(runs.fine_sqrt2, 1, runs.paper);
  const LogRatio cross = CrossWindLogRatio(runs.closed_form, kSqrt2, runs.paper);
  const auto rms = [&](const char* what, const LogRatio& ratio, double tolerance) {
    study.comparisons.push_back(
        {.quantity = absl::StrCat("Table 3 along wind, rms of ln(", what, " / paper)"),
         .unit = "1",
         .ours = ratio.rms,
         .verdict = Agrees(ratio.rms <= tolerance),
         .basis = absl::StrFormat(
             "at most %g over the clean cells; the worst is off by %+.3f. sqrt 2 is a guess at a slip in the "
             "paper's program, not physics",
             tolerance, ratio.greatest)});
  };
  study.comparisons.push_back(
      {.quantity = "Table 3 along wind, closed form over paper (mean logarithm)",
       .unit = "1",
       .published = 1,
       .ours = std::exp(plain.mean),
       .verdict = Agrees(std::abs(plain.mean) <= kClosedFormRms),
       .basis =
           absl::StrFormat("within 8 %%: the physics of the model gives less than is printed, by a factor of "
                           "%.3f",
                           std::exp(-plain.mean))});
  rms("sqrt 2 closed form", closed_form, kClosedFormRms);
  rms("sqrt 2 Monte Carlo", monte_carlo, kMonteCarloRms);
  rms("Monte Carlo with heights times sqrt 2", scaled, kMonteCarloRms);
  study.comparisons.push_back({.quantity = "Table 3 cross wind, rms of ln(sqrt 2 closed form / paper)",
                               .unit = "1",
                               .ours = cross.rms,
                               .verdict = Agrees(cross.rms <= kClosedFormRms),
                               .basis = "at most 0.08 over the clean cells, as along the wind: the printed "
                                        "angles hardly rise with wind and fall with incidence, ours rise "
                                        "with both"});
}

void CompareTrends(const Runs& runs, Study& study) {
  const RefractionGrid printed = GridOf(runs.paper);
  const auto compare = [&](const std::string& quantity, const Count& published, const Count& ours) {
    study.comparisons.push_back({.quantity = absl::StrCat(quantity, ", of ", ours.all),
                                 .unit = "cases",
                                 .published = published.all == 0 ? kNoNumber : published.holds,
                                 .ours = static_cast<double>(ours.holds),
                                 .verdict = Agrees(ours.holds == ours.all),
                                 .basis = "all of them, as the paper says of its results"});
  };
  compare("Along wind rises from one wind to the next", AlongWindRisesWithWind(printed),
          AlongWindRisesWithWind(runs.fine));
  compare("Along wind rises from one incidence to the next", AlongWindRisesWithIncidence(printed),
          AlongWindRisesWithIncidence(runs.fine));
  compare("Along wind exceeds cross wind", AlongWindExceedsCrossWind(printed),
          AlongWindExceedsCrossWind(runs.fine));
  Count falling;
  for (std::size_t d = 1; d < runs.by_diameter.size(); ++d) {
    for (std::size_t c = 0; c < runs.by_diameter[d].cells.size(); ++c)
      falling.Add(runs.by_diameter[d].cells[c].along.value < runs.by_diameter[d - 1].cells[c].along.value);
  }
  compare("Along wind falls from one diameter to the next", {}, falling);

  const auto line = [&](const char* whose, const RefractionGrid& grid, double least, const std::string& why) {
    study.comparisons.push_back({.quantity = absl::StrCat("Lowest R^2 of along wind over wind, ", whose),
                                 .unit = "1",
                                 .published = LowestRSquared(printed),
                                 .ours = LowestRSquared(grid),
                                 .verdict = Agrees(LowestRSquared(grid) >= least),
                                 .basis = absl::StrFormat("at least %.2f: %s", least, why)});
  };
  line("closed form", runs.closed_form, kClosedFormRSquared, "the theory bends slightly");
  const double fine_error = GreatestRelativeStandardError(runs.fine);
  line("fine Monte Carlo", runs.fine, fine_error <= kFineStandardError ? kFineRSquared : kPaperRSquared,
       absl::StrFormat("the angles have standard errors of at most %.1g %%", 100 * fine_error));
  line("Monte Carlo of the paper's size", runs.by_diameter.front(), kPaperRSquared,
       "a standard error of 3 %, in the lowest of five lines");
}

void CompareModels(const Runs& runs, Study& study) {
  const auto coefficients = [&](const char* name, const AngleModel& published, const AngleModel& ours) {
    const auto add = [&](const char* what, const char* unit, double paper, double our) {
      study.comparisons.push_back({.quantity = absl::StrCat(name, ", ", what),
                                   .unit = unit,
                                   .published = paper,
                                   .ours = our,
                                   .verdict = Verdict::kReported,
                                   .basis =
                                       "the fit to our closed form, as it is; printed coefficients follow "
                                       "printed angles, which are some 1.4 times ours"});
    };
    add("coefficient of theta w", "s/m", published.wind_incidence, ours.wind_incidence);
    add("coefficient of w", "degree s/m", published.wind, ours.wind);
    add("coefficient of theta", "1", published.incidence, ours.incidence);
    add("constant", "degree", published.constant, ours.constant);
  };
  coefficients("Eq. 27", kPublishedAlongWind, FitAngleModel(AlongWindSamples(runs.closed_form)));
  coefficients("Eq. 28", kPublishedCrossWind, FitAngleModel(CrossWindSamples(runs.closed_form)));
  const auto exponent = [&](const char* name, double published, double ours) {
    study.comparisons.push_back({.quantity = absl::StrCat(name, ", exponent of the diameter"),
                                 .unit = "1",
                                 .published = published,
                                 .ours = ours,
                                 .verdict = Verdict::kReported,
                                 .basis =
                                     "a power law through the means over winds and incidences of the closed "
                                     "form; as printed Eq. 29 and 30 are not 1 at 0.25 m"});
  };
  exponent("Eq. 29", kPublishedAlongWindExponent,
           FallWithDiameter(runs.closed_form_by_diameter, &RefractionGrid::Cell::along).exponent);
  exponent("Eq. 30", kPublishedCrossWindExponent,
           FallWithDiameter(runs.closed_form_by_diameter, &RefractionGrid::Cell::cross).exponent);
}

DataTable Table3(const Runs& runs) {
  DataTable table{
      .name = "table_3",
      .title = "Table 3 as printed, and ours: 2 sigma refraction, 0.25 m footprint, fully developed sea",
      .columns = {"wind_speed_m_s", "incidence_deg", "paper_along_deg", "along_reading",
                  "closed_form_along_deg", "monte_carlo_along_deg", "monte_carlo_along_se_deg",
                  "sqrt2_monte_carlo_along_deg", "sqrt2_monte_carlo_along_se_deg",
                  "ln_sqrt2_closed_form_over_paper_along", "paper_cross_deg", "cross_reading",
                  "closed_form_cross_deg", "monte_carlo_cross_deg", "monte_carlo_cross_se_deg",
                  "sqrt2_monte_carlo_cross_deg", "sqrt2_monte_carlo_cross_se_deg",
                  "ln_sqrt2_closed_form_over_paper_cross"},
      .rows = {}};
  const auto reading = [](bool clean) { return std::string(clean ? "clean" : "doubtful"); };
  for (std::size_t w = 0; w < runs.paper.wind_speeds.size(); ++w) {
    for (std::size_t i = 0; i < runs.paper.incidences.size(); ++i) {
      const PublishedAngles::Cell& paper = runs.paper.At(w, i);
      const RefractionGrid::Cell &theory = runs.closed_form.At(w, i), &ours = runs.fine.At(w, i),
                                 &scaled = runs.fine_sqrt2.At(w, i);
      table.rows.push_back({runs.paper.wind_speeds[w], runs.paper.incidences[i], paper.along,
                            reading(paper.along_is_clean), theory.along.value, ours.along.value,
                            ours.along.standard_error, scaled.along.value, scaled.along.standard_error,
                            std::log(kSqrt2 * theory.along.value / paper.along), paper.cross,
                            reading(paper.cross_is_clean), theory.cross.value, ours.cross.value,
                            ours.cross.standard_error, scaled.cross.value, scaled.cross.standard_error,
                            std::log(kSqrt2 * theory.cross.value / paper.cross)});
    }
  }
  return table;
}

DataTable LinesInWind(const Runs& runs) {
  DataTable table{.name = "table_3_lines",
                  .title = "Lines through the along-wind angles over wind, one for each incidence",
                  .columns = {"whose", "incidence_deg", "slope_deg_s_m", "intercept_deg", "r_squared"},
                  .rows = {}};
  const auto add = [&](const char* whose, const RefractionGrid& grid) {
    const std::vector<LineFit> fits = FitAlongWindByIncidence(grid);
    for (std::size_t i = 0; i < fits.size(); ++i) {
      table.rows.push_back({std::string(whose), grid.options.incidences[i], fits[i].slope, fits[i].intercept,
                            fits[i].r_squared});
    }
  };
  add("paper", GridOf(runs.paper));
  add("closed form", runs.closed_form);
  add("fine Monte Carlo", runs.fine);
  add("fine Monte Carlo, heights times sqrt 2", runs.fine_sqrt2);
  add("Monte Carlo of the paper's size", runs.by_diameter.front());
  return table;
}

DataTable Models(const Runs& runs) {
  DataTable table{.name = "equations_27_28",
                  .title =
                      "Eq. 27 (along wind) and 28 (cross wind): (a theta + b) w + c theta + d in degrees, "
                      "theta in degrees, w in m/s",
                  .columns = {"axis", "whose", "a", "b", "c", "d"},
                  .rows = {}};
  const auto row = [&](const char* axis, const char* whose, const AngleModel& model) {
    table.rows.push_back({std::string(axis), std::string(whose), model.wind_incidence, model.wind,
                          model.incidence, model.constant});
  };
  const RefractionGrid printed = GridOf(runs.paper);
  row("along", "printed, read with 0.0276", kPublishedAlongWind);
  row("along", "our fit to Table 3", FitAngleModel(AlongWindSamples(printed)));
  row("along", "our fit to our closed form", FitAngleModel(AlongWindSamples(runs.closed_form)));
  row("along", "our fit to our Monte Carlo", FitAngleModel(AlongWindSamples(runs.fine)));
  row("along", "the same, heights times sqrt 2", FitAngleModel(AlongWindSamples(runs.fine_sqrt2)));
  row("cross", "printed, read with 0.0281", kPublishedCrossWind);
  row("cross", "our fit to Table 3", FitAngleModel(CrossWindSamples(printed)));
  row("cross", "our fit to our closed form", FitAngleModel(CrossWindSamples(runs.closed_form)));
  row("cross", "our fit to our Monte Carlo", FitAngleModel(CrossWindSamples(runs.fine)));
  row("cross", "the same, heights times sqrt 2", FitAngleModel(CrossWindSamples(runs.fine_sqrt2)));
  return table;
}

DataTable Figure8(const Runs& runs) {
  DataTable table{
      .name = "figure_8",
      .title = "Figure 8: along-wind 2 sigma at 15 degrees over wind, for each diameter",
      .columns = {"diameter_m", "wind_speed_m_s", "monte_carlo_deg", "monte_carlo_se_deg", "closed_form_deg",
                  "line_deg", "line_slope_deg_s_m", "line_r_squared", "equation_27_29_deg"},
      .rows = {}};
  const std::vector<double>& incidences = runs.paper.incidences;
  const auto i = static_cast<std::size_t>(std::find(incidences.begin(), incidences.end(), kFigure8Incidence) -
                                          incidences.begin());
  for (std::size_t d = 0; d < kDiameters.size() && i < incidences.size(); ++d) {
    const LineFit line = FitAlongWindByIncidence(runs.by_diameter[d])[i];
    for (std::size_t w = 0; w < runs.paper.wind_speeds.size(); ++w) {
      const double wind_speed = runs.paper.wind_speeds[w];
      const Estimate& ours = runs.by_diameter[d].At(w, i).along;
      table.rows.push_back({kDiameters[d], wind_speed, ours.value, ours.standard_error,
                            runs.closed_form_by_diameter[d].At(w, i).along.value, line(wind_speed),
                            line.slope, line.r_squared,
                            kPublishedAlongWind(wind_speed, kFigure8Incidence) *
                                PublishedAlongWindDiameterFactor(kDiameters[d])});
    }
  }
  return table;
}

DataTable Figure9(const Runs& runs) {
  DataTable table{.name = "figure_9",
                  .title = "Figure 9: 2 sigma over the diameter, mean of all winds and incidences",
                  .columns = {"diameter_m", "monte_carlo_along_deg", "monte_carlo_along_se_deg",
                              "closed_form_along_deg", "equations_along_deg", "monte_carlo_cross_deg",
                              "monte_carlo_cross_se_deg", "closed_form_cross_deg", "equations_cross_deg"},
                  .rows = {}};
  for (std::size_t d = 0; d < kDiameters.size(); ++d) {
    double along = 0, cross = 0;
    for (const double wind_speed : runs.paper.wind_speeds) {
      for (const double incidence : runs.paper.incidences) {
        along += kPublishedAlongWind(wind_speed, incidence) / static_cast<double>(runs.paper.cells.size());
        cross += kPublishedCrossWind(wind_speed, incidence) / static_cast<double>(runs.paper.cells.size());
      }
    }
    const Estimate ours_along = MeanOf(runs.by_diameter[d], &RefractionGrid::Cell::along);
    const Estimate ours_cross = MeanOf(runs.by_diameter[d], &RefractionGrid::Cell::cross);
    table.rows.push_back({kDiameters[d], ours_along.value, ours_along.standard_error,
                          MeanOf(runs.closed_form_by_diameter[d], &RefractionGrid::Cell::along).value,
                          along * PublishedAlongWindDiameterFactor(kDiameters[d]), ours_cross.value,
                          ours_cross.standard_error,
                          MeanOf(runs.closed_form_by_diameter[d], &RefractionGrid::Cell::cross).value,
                          cross * PublishedCrossWindDiameterFactor(kDiameters[d])});
  }
  return table;
}

std::vector<std::string> Text(const Runs& runs, const StudyOptions& options) {
  const SimulationSize fine = options.quick ? kQuickFineRun : kFineRun;
  const SimulationSize as_paper = options.quick ? kQuickPaperRun : kPaperRun;
  const LogRatio plain = AlongWindLogRatio(runs.closed_form, 1, runs.paper);
  const LogRatio scaled = AlongWindLogRatio(runs.closed_form, kSqrt2, runs.paper);
  const auto narrow = runs.closed_form_by_diameter.front(), wide = runs.closed_form_by_diameter.back();
  const auto ratio = [&](Estimate RefractionGrid::Cell::*axis) {
    return MeanOf(wide, axis).value / MeanOf(narrow, axis).value;
  };
  return {
      absl::StrFormat(
          "The conditions of Table 1 on the fully developed sea: a uniform beam whose plane of incidence "
          "lies along the wind. Two runs: one of the paper's size, %d surfaces of %s rays for every "
          "diameter, by tracing alone; and one of %d surfaces at 0.25 m, which takes what the mean slope of "
          "each surface explains from its known variance, with standard errors of at most %.1g %%. All waves "
          "are in both: short ones by FFT, those longer than the patch as plane waves, up to the longest of "
          "the sea, so no domain cuts them off. All incidences of a wind look at the same surfaces.",
          as_paper.surfaces, as_paper.rays ? "10,000" : "4,000 or more", fine.surfaces,
          100 * GreatestRelativeStandardError(runs.fine)),
      absl::StrFormat("As physics gives it, the along-wind angles are %.2f of those printed in the mean, "
                      "closed form and Monte Carlo alike. One factor on all slopes brings them together: the "
                      "best is %.3f, next to sqrt 2. A slip in making real heights from Hermitian amplitudes "
                      "(each wave at its full variance for k and for -k) would do this; we cannot know. With "
                      "sqrt 2 the along-wind cells agree within %.1f %% rms and %.0f %% at worst. The ratio "
                      "is not one number: the printed angles rise less with wind than ours.",
                      std::exp(plain.mean), std::exp(-plain.mean), 100 * scaled.rms,
                      100 * std::abs(scaled.greatest)),
      "Across the wind the printed angles hardly rise with wind and fall with incidence. Refraction in a "
      "plane of incidence along the wind gives neither: the gain across that plane, 1 - cos(theta) / (n "
      "cos(theta_r)), rises with incidence, and the slopes across the wind rise with it. It stands as a "
      "difference.",
      absl::StrFormat("The angles fall with the diameter as the footprint averages waves out. Ours fall to "
                      "%.2f (along) and %.2f (cross) from 0.25 m to 4 m; Eq. 29 and 30, as ratios, to %.2f "
                      "and %.2f.",
                      ratio(&RefractionGrid::Cell::along), ratio(&RefractionGrid::Cell::cross),
                      PublishedAlongWindDiameterFactor(4), PublishedCrossWindDiameterFactor(4)),
      "Three cells of Table 3 are damaged in the text that we have; they are shown as read, marked as "
      "doubtful, and count nowhere but in the lines through the paper's own cells.",
  };
}

}  // namespace

absl::StatusOr<Study> PaperMonteCarloStudy(const StudyOptions& options) {
  absl::StatusOr<PublishedAngles> paper = ReadTable3(options.published);
  if (!paper.ok()) return paper.status();
  const Runs runs = RunAll(*std::move(paper), options);

  Study study;
  study.id = "table_3";
  study.title = "Table 3, Figures 8 and 9: the paper's Monte Carlo";
  study.paragraphs = Text(runs, options);
  CompareTable3(runs, study);
  CompareTrends(runs, study);
  CompareModels(runs, study);
  study.tables = {Table3(runs), LinesInWind(runs), Models(runs), Figure8(runs), Figure9(runs)};
  study.figures = {
      {.name = "table_3_angles",
       .caption =
           "Table 3 (points; hollow: doubtful) beside ours as physics gives it (full lines) and with all "
           "heights times sqrt 2 (broken lines), along and across the wind, at nadir and at 20 degrees."},
      {.name = "figure_8",
       .caption =
           "Figure 8: along-wind 2 sigma at 15 degrees over wind for each diameter: ours with one standard "
           "error, and the line through them."},
      {.name = "figure_9",
       .caption =
           "Figure 9: 2 sigma over the diameter, mean of all winds and incidences: ours (points), the closed "
           "form (full lines) and Eq. 27-30 as read (broken lines)."}};
  return study;
}

}  // namespace albtpu
