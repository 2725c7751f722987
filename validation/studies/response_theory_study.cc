#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "sea/angle.h"
#include "sea/response/closed_form.h"
#include "status/status_macros.h"
#include "tables/s44.h"
#include "validation/published/published_angles.h"
#include "validation/published/published_table.h"
#include "validation/studies/response_comparison.h"
#include "validation/studies/studies.h"

namespace albtpu {
namespace {

constexpr int kDraws = 10'000;  // the paper's

// Half a unit of the second decimal printed, and as much again for the paper's draws, whose standard error is 1 /
// sqrt(2 * 10,000) = 0.7 % of a value (0.0074 m for the largest).
constexpr double kQuadratureTolerance = 0.010;  // m
// The rounding, and three standard errors of the difference of our draws and the paper's at the largest value, 1.05 m,
// rounded down.
constexpr double kDrawsTolerance = 0.03;  // m
// Half a unit of the second decimal, since a limit has no other error; 1e-9 for the rounding of binary fractions.
constexpr double kLimitTolerance = 0.005 + 1e-9;  // m

struct Table5 {
  std::vector<double> depth, thu, thu_limit, tvu, tvu_limit;
};

absl::StatusOr<Table5> ReadTable5(const std::filesystem::path& folder) {
  ASSIGN_OR_RETURN(const PublishedTable table, PublishedTable::Read(folder / "table5_thu_tvu.csv"));
  ASSIGN_OR_RETURN(const auto columns, table.Numbers({"depth_m", "thu_m", "iho_1b_thu_m", "tvu_m", "iho_1b_tvu_m"}));
  return Table5{columns[0], columns[1], columns[2], columns[3], columns[4]};
}

Verdict Judge(double departure, double tolerance) { return AgreesIf(std::abs(departure) <= tolerance); }

void CompareByQuadrature(const Table5& paper, const AngleMethodUncertainty& ours, Study& study) {
  const auto compare = [&](const char* name, double depth, double published, double per_depth) {
    study.comparisons.push_back({.quantity = absl::StrFormat("%s at %g m, by quadrature", name, depth),
                                 .unit = "m",
                                 .published = published,
                                 .ours = depth * per_depth,
                                 .verdict = Judge(depth * per_depth - published, kQuadratureTolerance),
                                 .basis = "within 0.010 m: half a unit of the second decimal printed, and as "
                                          "much for the scatter of the paper's 10,000 draws"});
  };
  for (std::size_t i = 0; i < paper.depth.size(); ++i) {
    compare("THU", paper.depth[i], paper.thu[i], ours.thu_per_depth);
    compare("TVU", paper.depth[i], paper.tvu[i], ours.tvu_per_depth);
  }
}

double LargestDeparture(const std::vector<double>& depth, const std::vector<double>& published, double per_depth) {
  double greatest = 0;
  for (std::size_t i = 0; i < depth.size(); ++i)
    greatest = std::max(greatest, std::abs(depth[i] * per_depth - published[i]));
  return greatest;
}

void CompareByDraws(const Table5& paper, const AngleMethodUncertainty& draws, Study& study) {
  const double greatest = std::max(LargestDeparture(paper.depth, paper.thu, draws.thu_per_depth),
                                   LargestDeparture(paper.depth, paper.tvu, draws.tvu_per_depth));
  study.comparisons.push_back({.quantity = "Greatest departure of the 20 values with 10,000 draws",
                               .unit = "m",
                               .ours = greatest,
                               .verdict = Judge(greatest, kDrawsTolerance),
                               .basis = "within 0.03 m: the rounding, and three standard errors of our draws "
                                        "and the paper's, 0.7 % each, at 1.05 m"});
}

void CompareLimits(const Table5& paper, Study& study) {
  double greatest = 0;
  for (std::size_t i = 0; i < paper.depth.size(); ++i) {
    greatest = std::max({greatest, std::abs(ThuLimitAsPrintedByBirkebak(paper.depth[i]) - paper.thu_limit[i]),
                         std::abs(TvuLimit(S44Order::k1b, paper.depth[i]) - paper.tvu_limit[i])});
  }
  study.comparisons.push_back({.quantity = "Greatest departure of the 20 limits of order 1b by Eq. 22 and 23",
                               .unit = "m",
                               .ours = greatest,
                               .verdict = Judge(greatest, kLimitTolerance),
                               .basis = "within 0.005 m, the rounding of two decimals"});
  const double depth = paper.depth.back();
  const double limit = ThuLimit(S44Order::k1b, depth);
  study.comparisons.push_back({.quantity = absl::StrFormat("THU limit of order 1b in S-44 itself at %g m", depth),
                               .unit = "m",
                               .published = paper.thu_limit.back(),
                               .ours = limit,
                               .verdict = Judge(limit - paper.thu_limit.back(), kLimitTolerance),
                               .basis = absl::StrCat("within 0.005 m of 5 m + 5 % of the depth (",
                                                     std::string(kS44Edition), "); the paper prints 2 %")});
}

DataTable BesideTable5(const Table5& paper, const AngleMethodUncertainty& quadrature,
                       const AngleMethodUncertainty& draws) {
  DataTable table{
      .name = "table_5",
      .title = "Table 5 as printed (columns of the paper), and by the angle method from the angles of Table 4",
      .columns = {"depth_m", "paper_thu_m", "quadrature_thu_m", "draws_thu_m", "paper_tvu_m", "quadrature_tvu_m",
                  "draws_tvu_m", "paper_1b_thu_limit_m", "eq_22_thu_limit_m", "s44_1b_thu_limit_m",
                  "paper_1b_tvu_limit_m", "s44_1b_tvu_limit_m"}};
  for (std::size_t i = 0; i < paper.depth.size(); ++i) {
    const double d = paper.depth[i];
    table.Add(d, paper.thu[i], d * quadrature.thu_per_depth, d * draws.thu_per_depth, paper.tvu[i],
              d * quadrature.tvu_per_depth, d * draws.tvu_per_depth, paper.thu_limit[i], ThuLimitAsPrintedByBirkebak(d),
              ThuLimit(S44Order::k1b, d), paper.tvu_limit[i], TvuLimit(S44Order::k1b, d));
  }
  return table;
}

}  // namespace

absl::StatusOr<Study> AngleMethodStudy(const StudyOptions& options) {
  ASSIGN_OR_RETURN(const PublishedAngles measured, ReadTable4(options.published));
  ASSIGN_OR_RETURN(const Table5 paper, ReadTable5(options.published));

  // Table 5 is made from the last row and column of Table 4.
  const PublishedAngles::Cell& cell = measured.cells.back();
  const double wind_speed = measured.wind_speeds.back();
  const double incidence = RadiansOfDegrees(measured.incidences.back());
  const double angle = RadiansOfDegrees(std::hypot(cell.along, cell.cross));
  const double refracted = StillWaterRefraction(incidence, kRefractiveIndex);
  const AngleMethodUncertainty quadrature = AngleMethod(refracted, angle);
  const AngleMethodUncertainty draws = AngleMethodByDraws(refracted, angle, kDraws, NormalStream(options.seed, 0, 0));
  const AngleMethodUncertainty in_air = AngleMethod(incidence, angle);

  Study study;
  study.id = "table_5";
  study.title = "Table 5: THU and TVU from measured angles";
  study.paragraphs = {
      absl::StrFormat("Eq. 24-26 convert a refraction angle to THU and TVU. theta is the angle of the ray in still "
                      "water, %.2f degrees for the %g degrees in air of the table, and delta theta is normal with 2 "
                      "sigma = sqrt(along^2 + cross^2) = %.3f degrees from Table 4 at %g m/s. We evaluate them by "
                      "quadrature, which has no random error, and with one set of 10,000 draws as in the paper.",
                      DegreesOfRadians(refracted), measured.incidences.back(), DegreesOfRadians(angle), wind_speed),
      absl::StrFormat(
          "The paper does not say in which medium theta is measured. With the incidence in air the THU at 10 "
          "m would be %.2f m and the TVU %.2f m, while the paper prints %.2f m and %.2f m.",
          10 * in_air.thu_per_depth, 10 * in_air.tvu_per_depth, paper.thu.back(), paper.tvu.back()),
      "The paper's limits for order 1b follow from its Eq. 22 and 23. Eq. 22 allows 5 m plus 2 % of the "
      "depth, S-44 itself 5 m plus 5 %: the paper is stricter, and its conclusion stands. These THU and TVU "
      "are 2 sigma values; the limits are for 95 %."};
  CompareByQuadrature(paper, quadrature, study);
  CompareByDraws(paper, draws, study);
  CompareLimits(paper, study);
  study.tables = {BesideTable5(paper, quadrature, draws)};
  study.figures = {{.name = "table_5_thu_tvu",
                    .caption =
                        "THU and TVU over depth: Table 5 (points) and the angle method (lines), with the TVU limit "
                        "of S-44 order 1b. The THU limit, above 5 m, is off the scale."}};
  return study;
}

namespace {

DataTable EachBeam(const std::vector<ComparedBeam>& beams, std::string name, std::string title) {
  DataTable table{.name = std::move(name),
                  .title = std::move(title),
                  .columns = {"sea", "incidence_deg", "azimuth_deg", "footprint_m", "profile", "refractive_index",
                              "seen", "quantity", "ratio", "standard_error"},
                  .on_the_page = false};
  for (const ComparedBeam& each : beams) {
    for (const ComparedQuantity quantity : kComparedQuantities) {
      const Estimate ratio = RatioOf(each, quantity);
      if (std::isnan(ratio.value)) continue;
      table.Add(each.sea, DegreesOfRadians(each.beam.incidence), DegreesOfRadians(each.beam.azimuth),
                each.beam.footprint, Name(each.beam.profile), each.refractive_index, each.seen, Name(quantity), ratio);
    }
  }
  return table;
}

DataTable EachSea(const std::vector<ComparedBeam>& beams) {
  DataTable table{.name = "response_theory",
                  .title =
                      "Theory over tracing on each sea: departures from 1 in %, rms and standard error of the "
                      "tracing, at a depth of 20 m",
                  .columns = {"sea", "beams", "along_rms", "along_error", "cross_rms", "cross_error", "thu_rms",
                              "thu_error", "tvu_rms", "tvu_error"}};
  for (std::size_t first = 0; first < beams.size();) {
    std::size_t last = first;
    while (last < beams.size() && beams[last].sea == beams[first].sea) ++last;
    const std::vector<ComparedBeam> of_sea(beams.begin() + first, beams.begin() + last);
    std::vector<Cell> errors;
    for (const ComparedQuantity quantity :
         {ComparedQuantity::kAlong, ComparedQuantity::kCross, ComparedQuantity::kThu, ComparedQuantity::kTvu}) {
      const Agreement found = AgreementOf(of_sea, quantity, 0);
      errors.push_back(found.beams > 0 ? 100 * found.rms : kNoNumber);
      errors.push_back(found.beams > 0 ? 100 * found.standard_error : kNoNumber);
    }
    table.Add(of_sea.front().sea, of_sea.size(), errors);
    first = last;
  }
  return table;
}

}  // namespace

absl::StatusOr<Study> ResponseTheoryStudy(const StudyOptions& options) {
  const std::vector<ComparedBeam> many =
      CompareRandomBeams(ResponseSeas(), options.quick, {.realizations = options.quick ? 100 : 300}, options.seed);
  const std::vector<ComparedBeam> resolved = CompareRandomBeams(
      ResolvedSeas(), options.quick, {.realizations = options.quick ? 160 : 500, .finer = 2}, options.seed);
  Study study;
  study.id = "response_theory";
  study.title = "The response theory: any sea without a table";
  study.paragraphs = {
      "A sea that is measured or described has no table. Its numbers come from its spectrum alone, by a theory "
      "without a fitted number: the mean refracted ray of a beam is a function of Gaussian slopes and heights, "
      "whose covariance under the footprint is an integral over the spectrum. The variance of the errors is "
      "exact to the fourth order in slope. docs/physics.md derives it in the section \"Finite slopes\".",
      "Here it is compared with the Monte Carlo, which traces rays and does not use it, on random beams: "
      "incidences up to 30 degrees, footprints from 0.2 to 6 m, uniform and gaussian, refractive indices from "
      "1.33 to 1.345, on wind seas and described ones. A second comparison is on seas without waves shorter "
      "than some 0.2 m, all of which a grid can hold, with a grid twice as fine.",
      "Its limits: terms of the sixth order in slope are left out, 0.02 % of THU and 0.14 % of TVU at a mean "
      "square slope of 0.15. At the depth 0 it is of leading order in slope, where some millimetres are at "
      "stake. It takes the sea as Gaussian, as the Monte Carlo does."};
  study.comparisons = VerdictsOnManySeas(many);
  for (Comparison& verdict : VerdictsOnResolvedSeas(resolved)) study.comparisons.push_back(std::move(verdict));
  study.tables = {
      EachSea(many), EachBeam(many, "response_theory_many_seas", "Each beam on many seas, theory over tracing"),
      EachBeam(resolved, "response_theory_resolved_seas", "Each beam on seas that a grid holds, theory over tracing")};
  study.figures = {{.name = "response_theory",
                    .caption = "The theory over tracing for each beam, by the fraction of the mean square slope "
                               "that its footprint passes. Bars are standard errors of the tracing."}};
  return study;
}

}  // namespace albtpu
