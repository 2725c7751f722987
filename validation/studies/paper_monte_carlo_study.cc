#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "status/status_macros.h"
#include "validation/published/paper_monte_carlo.h"
#include "validation/published/published_angles.h"
#include "validation/published/published_tables.h"
#include "validation/published/refraction_grid.h"
#include "validation/studies/studies.h"

namespace albtpu {
namespace {

constexpr double kSqrt2 = std::numbers::sqrt2;
// The relative standard error at or below which the fine run is judged by a limit of its own.
constexpr double kFineStandardError = 0.008;

// The criterion of agreement, as rms of ln(sqrt 2 ours / paper) over the clean cells: the 500 surfaces of the paper
// scatter by 3.2 %, its trend in wind differs from ours by some 6 %, and simulated angles may add 4 % of nonlinearity
// and chance. A slope variance that is wrong by a quarter does not meet it.
constexpr double kClosedFormRms = 0.08, kMonteCarloRms = 0.12;
// For R^2 of a line through six winds: the theory is slightly curved; 0.8 % of noise takes off 0.002, 3.2 % some 0.03
// on average and 0.1 from the lowest of five lines.
constexpr double kClosedFormRSquared = 0.97, kFineRSquared = 0.95, kPaperRSquared = 0.80;

PowerLaw FallWithDiameter(const std::vector<RefractionGrid>& grids, AngleAxis axis) {
  std::vector<double> means;
  for (const RefractionGrid& grid : grids) means.push_back(MeanAngle(grid, axis).value);
  return FitPowerLaw(kPaperDiameters, means);
}

void CompareTable3(const PaperMonteCarlo& runs, Study& study) {
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
         .verdict = AgreesIf(ratio.rms <= tolerance),
         .basis = absl::StrFormat("at most %g over the clean cells; the worst differs by %+.3f. sqrt 2 is a "
                                  "guess at an error in the paper's program, not physics",
                                  tolerance, ratio.greatest)});
  };
  study.comparisons.push_back(
      {.quantity = "Table 3 along wind, ratio of closed form to paper (mean logarithm)",
       .unit = "1",
       .published = 1,
       .ours = std::exp(plain.mean),
       .verdict = AgreesIf(std::abs(plain.mean) <= kClosedFormRms),
       .basis = absl::StrFormat(
           "within 8 %%: the physics of the model gives smaller angles than printed, by a factor of %.3f",
           std::exp(-plain.mean))});
  rms("sqrt 2 closed form", closed_form, kClosedFormRms);
  rms("sqrt 2 Monte Carlo", monte_carlo, kMonteCarloRms);
  rms("Monte Carlo with heights times sqrt 2", scaled, kMonteCarloRms);
  study.comparisons.push_back(
      {.quantity = "Table 3 cross wind, rms of ln(sqrt 2 closed form / paper)",
       .unit = "1",
       .ours = cross.rms,
       .verdict = AgreesIf(cross.rms <= kClosedFormRms),
       .basis = "at most 0.08 over the clean cells, as along the wind: the printed angles hardly rise with "
                "wind and fall with incidence, while ours rise with both"});
}

void CompareTrends(const PaperMonteCarlo& runs, Study& study) {
  const RefractionGrid printed = GridOf(runs.paper);
  const auto compare = [&](const std::string& quantity, const CaseCount& published, const CaseCount& ours) {
    study.comparisons.push_back({.quantity = absl::StrCat(quantity, ", of ", ours.all),
                                 .unit = "cases",
                                 .published = published.all == 0 ? kNoNumber : published.holds,
                                 .ours = static_cast<double>(ours.holds),
                                 .verdict = AgreesIf(ours.holds == ours.all),
                                 .basis = "all cases, as the paper states for its results"});
  };
  compare("Along wind rises from one wind to the next", AlongWindRisesWithWind(printed),
          AlongWindRisesWithWind(runs.fine));
  compare("Along wind rises from one incidence to the next", AlongWindRisesWithIncidence(printed),
          AlongWindRisesWithIncidence(runs.fine));
  compare("Along wind exceeds cross wind", AlongWindExceedsCrossWind(printed), AlongWindExceedsCrossWind(runs.fine));
  CaseCount falling;
  for (std::size_t d = 1; d < runs.by_diameter.size(); ++d)
    for (std::size_t c = 0; c < runs.by_diameter[d].cells.size(); ++c)
      falling.Add(runs.by_diameter[d].cells[c].along.value < runs.by_diameter[d - 1].cells[c].along.value);
  compare("Along wind falls from one diameter to the next", {}, falling);

  const auto line = [&](const char* whose, const RefractionGrid& grid, double least, const std::string& why) {
    study.comparisons.push_back({.quantity = absl::StrCat("Lowest R^2 of along wind over wind, ", whose),
                                 .unit = "1",
                                 .published = LowestRSquared(printed),
                                 .ours = LowestRSquared(grid),
                                 .verdict = AgreesIf(LowestRSquared(grid) >= least),
                                 .basis = absl::StrFormat("at least %.2f: %s", least, why)});
  };
  line("closed form", runs.closed_form, kClosedFormRSquared, "the theory is slightly curved");
  const double fine_error = LargestRelativeStandardError(runs.fine);
  line("fine Monte Carlo", runs.fine, fine_error <= kFineStandardError ? kFineRSquared : kPaperRSquared,
       absl::StrFormat("the angles have standard errors of at most %.1g %%", 100 * fine_error));
  const double plain_error = LargestRelativeStandardError(runs.by_diameter.front());
  line(runs.plain_name.c_str(), runs.by_diameter.front(), kPaperRSquared,
       absl::StrFormat("the angles have standard errors of at most %.1f %%; the lowest of five lines",
                       100 * plain_error));
}

void CompareModels(const PaperMonteCarlo& runs, Study& study) {
  const auto coefficients = [&](const char* name, const AngleModel& published, const AngleModel& ours) {
    const auto add = [&](const char* what, const char* unit, double paper, double our) {
      study.comparisons.push_back({.quantity = absl::StrCat(name, ", ", what),
                                   .unit = unit,
                                   .published = paper,
                                   .ours = our,
                                   .basis = "the fit to our unscaled closed form; the printed coefficients "
                                            "follow the printed angles, which are some 1.4 times ours"});
    };
    add("coefficient of theta w", "s/m", published.wind_incidence, ours.wind_incidence);
    add("coefficient of w", "degree s/m", published.wind, ours.wind);
    add("coefficient of theta", "1", published.incidence, ours.incidence);
    add("constant", "degree", published.constant, ours.constant);
  };
  coefficients("Eq. 27", kPublishedAlongWind, FitAngleModel(runs.closed_form, kAlongWind));
  coefficients("Eq. 28", kPublishedCrossWind, FitAngleModel(runs.closed_form, kCrossWind));
  const auto exponent = [&](const char* name, double published, double ours) {
    study.comparisons.push_back({.quantity = absl::StrCat(name, ", exponent of the diameter"),
                                 .unit = "1",
                                 .published = published,
                                 .ours = ours,
                                 .basis = "a power law through the means of the closed form over winds and "
                                          "incidences; as printed, Eq. 29 and 30 are not 1 at 0.25 m"});
  };
  exponent("Eq. 29", kPublishedAlongWindExponent, FallWithDiameter(runs.closed_form_by_diameter, kAlongWind).exponent);
  exponent("Eq. 30", kPublishedCrossWindExponent, FallWithDiameter(runs.closed_form_by_diameter, kCrossWind).exponent);
}

std::vector<std::string> Text(const PaperMonteCarlo& runs, const PaperMonteCarloSize& size) {
  const LogRatio plain = AlongWindLogRatio(runs.closed_form, 1, runs.paper);
  const LogRatio scaled = AlongWindLogRatio(runs.closed_form, kSqrt2, runs.paper);
  const RefractionGrid &narrow = runs.closed_form_by_diameter.front(), &wide = runs.closed_form_by_diameter.back();
  const auto ratio = [&](AngleAxis axis) { return MeanAngle(wide, axis).value / MeanAngle(narrow, axis).value; };
  return {
      absl::StrFormat(
          "The conditions are those of Table 1 on the fully developed sea: a uniform beam whose plane of "
          "incidence is along the wind. There are two runs: one of %d surfaces%s for every diameter, by "
          "tracing alone, with standard errors of at most %.1f %%; and one of %d surfaces at 0.25 m, in "
          "which the part of the variance that the mean slope of each surface explains is taken from theory, "
          "with standard errors of at most %.1g %%. Both contain all waves: short ones by FFT, those longer "
          "than the patch as plane waves, up to the longest of the sea, so that no domain cuts them off. All "
          "incidences of a wind see the same surfaces.",
          size.plain.surfaces,
          size.plain.rays ? absl::StrFormat(" of %d rays, the paper's size,", *size.plain.rays) : "",
          100 * LargestRelativeStandardError(runs.by_diameter.front()), size.fine.surfaces,
          100 * LargestRelativeStandardError(runs.fine)),
      absl::StrFormat(
          "Without any scaling our along-wind angles are on average %.2f of the printed ones, in the closed "
          "form and in the Monte Carlo. One factor on all slopes brings them together: the best factor is "
          "%.3f, close to sqrt 2. An error in making real heights from Hermitian amplitudes (each wave with "
          "its full variance for both k and -k) would have this effect, but we cannot know. With sqrt 2 the "
          "along-wind cells agree within %.1f %% rms and %.0f %% at worst. The ratio is not constant: the "
          "printed angles rise less with wind than ours.",
          std::exp(plain.mean), std::exp(-plain.mean), 100 * scaled.rms, 100 * std::abs(scaled.greatest)),
      "Across the wind the printed angles hardly rise with wind and fall with incidence. Refraction in a "
      "plane of incidence along the wind does neither: the gain across that plane, 1 - cos(theta) / (n "
      "cos(theta_r)), rises with incidence, and the slopes across the wind rise with wind. This difference "
      "is unexplained.",
      absl::StrFormat("The angles fall with the diameter, because a wider footprint averages out more waves. "
                      "From 0.25 m to 4 m ours fall to %.2f (along) and %.2f (cross) of their value, those "
                      "of Eq. 29 and 30, as ratios, to %.2f and %.2f.",
                      ratio(kAlongWind), ratio(kCrossWind), PublishedAlongWindDiameterFactor(4),
                      PublishedCrossWindDiameterFactor(4)),
      "Three cells of Table 3 are damaged in our text copy of the paper. They are shown as read, marked as "
      "doubtful, and used only in the lines through the paper's cells.",
  };
}

}  // namespace

absl::StatusOr<Study> PaperMonteCarloStudy(const StudyOptions& options) {
  ASSIGN_OR_RETURN(PublishedAngles paper, ReadTable3(options.published));
  const PaperMonteCarloSize size = SizeOfPaperMonteCarlo(options.quick);
  const PaperMonteCarlo runs = RunPaperMonteCarlo(std::move(paper), size, options.seed);

  Study study;
  study.id = "table_3";
  study.title = "Table 3, Figures 8 and 9: the paper's Monte Carlo";
  study.paragraphs = Text(runs, size);
  CompareTable3(runs, study);
  CompareTrends(runs, study);
  CompareModels(runs, study);
  study.tables = {Table3(runs), LinesInWind(runs), AngleModels(runs), Figure8(runs), Figure9(runs)};
  study.figures = {
      {.name = "table_3_angles",
       .caption = "Table 3 (points), our closed form (solid lines) and our Monte Carlo with all heights "
                  "times sqrt 2 (dashed lines), along and across the wind, at nadir and at 20 degrees."},
      {.name = "figure_8",
       .caption = "Figure 8: 2 sigma along the wind at 15 degrees over wind for each diameter: ours with one "
                  "standard error, and the lines fitted to them."},
      {.name = "figure_9",
       .caption = "Figure 9: 2 sigma over the diameter, mean of all winds and incidences: ours (points), the "
                  "closed form (solid lines) and Eq. 27-30 as read (dashed lines)."}};
  return study;
}

}  // namespace albtpu
