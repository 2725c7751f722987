#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "sea/angle.h"
#include "validation/studies/response_comparison.h"
#include "validation/studies/studies.h"

namespace albtpu {
namespace {

DataTable EachBeam(const std::vector<ComparedBeam>& beams, std::string name, std::string title) {
  DataTable table{.name = std::move(name),
                  .title = std::move(title),
                  .columns = {"sea", "incidence_deg", "azimuth_deg", "footprint_m", "profile",
                              "refractive_index", "seen", "quantity", "ratio", "standard_error"},
                  .rows = {},
                  .on_the_page = false};
  for (const ComparedBeam& each : beams) {
    for (const ComparedQuantity quantity : kComparedQuantities) {
      const Estimate ratio = RatioOf(each, quantity);
      if (std::isnan(ratio.value)) continue;
      table.rows.push_back({each.sea, DegreesOfRadians(each.beam.incidence),
                            DegreesOfRadians(each.beam.azimuth), each.beam.footprint,
                            std::string(Name(each.beam.profile)), each.refractive_index, each.seen,
                            std::string(Name(quantity)), ratio.value, ratio.standard_error});
    }
  }
  return table;
}

DataTable EachSea(const std::vector<ComparedBeam>& beams) {
  DataTable table{
      .name = "response_theory",
      .title =
          "Theory over tracing on each sea: departures from 1 in %, rms and standard error of the "
          "tracing, at a depth of 20 m",
      .columns = {"sea", "beams", "along_rms", "along_error", "cross_rms", "cross_error", "thu_rms",
                  "thu_error", "tvu_rms", "tvu_error"},
      .rows = {}};
  for (std::size_t first = 0; first < beams.size();) {
    std::size_t last = first;
    while (last < beams.size() && beams[last].sea == beams[first].sea) ++last;
    const std::vector<ComparedBeam> of_sea(beams.begin() + first, beams.begin() + last);
    std::vector<Cell> row = {of_sea.front().sea, static_cast<double>(of_sea.size())};
    for (const ComparedQuantity quantity : {ComparedQuantity::kAlong, ComparedQuantity::kCross,
                                            ComparedQuantity::kThu, ComparedQuantity::kTvu}) {
      const Agreement found = AgreementOf(of_sea, quantity, 0);
      row.push_back(found.beams > 0 ? 100 * found.rms : kNoNumber);
      row.push_back(found.beams > 0 ? 100 * found.standard_error : kNoNumber);
    }
    table.rows.push_back(std::move(row));
    first = last;
  }
  return table;
}

}  // namespace

absl::StatusOr<Study> ResponseTheoryStudy(const StudyOptions& options) {
  const std::vector<ComparedBeam> many =
      CompareRandomBeams(ResponseSeas(), options.quick, {.realizations = 300}, options.seed);
  const std::vector<ComparedBeam> resolved =
      CompareRandomBeams(ResolvedSeas(), options.quick, {.realizations = 500, .finer = 2}, options.seed);
  Study study;
  study.id = "response_theory";
  study.title = "The response theory: any sea without a table";
  study.paragraphs = {
      "A sea that is measured or described has no table. Its numbers come from its spectrum alone, by a "
      "theory "
      "without a fitted number: the mean refracted ray of a beam is a function of Gaussian slopes and "
      "heights, "
      "whose covariance under the footprint is an integral over the spectrum. The variance of the errors is "
      "exact to the fourth order in slope. docs/physics.md derives it in the section \"Finite slopes\".",
      "Here it is compared with the Monte Carlo, which traces rays and does not use it, on random beams: "
      "incidences up to 30 degrees, footprints from 0.2 to 6 m, uniform and gaussian, refractive indices "
      "from "
      "1.33 to 1.345, on wind seas and described ones. A second comparison is on seas without waves shorter "
      "than some 0.2 m, all of which a grid can hold, with a grid twice as fine.",
      "Its limits: terms of the sixth order in slope are left out, 0.02 % of THU and 0.14 % of TVU at a mean "
      "square slope of 0.15. At the depth 0 it is of leading order in slope, where some millimetres are at "
      "stake. It takes the sea as Gaussian, as the Monte Carlo does."};
  study.comparisons = VerdictsOnManySeas(many);
  for (Comparison& verdict : VerdictsOnResolvedSeas(resolved))
    study.comparisons.push_back(std::move(verdict));
  study.tables = {EachSea(many),
                  EachBeam(many, "response_theory_many_seas", "Each beam on many seas, theory over tracing"),
                  EachBeam(resolved, "response_theory_resolved_seas",
                           "Each beam on seas that a grid holds, theory over tracing")};
  study.figures = {{.name = "response_theory",
                    .caption =
                        "The theory over tracing for each beam, by the fraction of the mean square slope "
                        "that its footprint passes. Bars are standard errors of the tracing."}};
  return study;
}

}  // namespace albtpu
