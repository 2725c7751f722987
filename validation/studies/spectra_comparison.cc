#include "validation/studies/spectra_comparison.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "generator/monte_carlo/monte_carlo.h"
#include "sea/angle.h"
#include "sea/response/closed_form.h"
#include "sea/sea_state.h"

namespace albtpu {
namespace {

// A point of the survey domain.
struct Point {
  double wind_speed, fetch, incidence, footprint;  // m/s, m, degree, m
};

std::vector<Point> SurveyDomain() {
  std::vector<Point> points;
  for (const double wind : {2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 15.0})
    for (const double fetch : {1e3, 1e4, 1e5, kFullyDeveloped})
      for (const double incidence : {0.0, 10.0, 20.0})
        for (const double footprint : {0.25, 0.5, 1.0, 2.0}) points.push_back({wind, fetch, incidence, footprint});
  return points;
}

SeaOptions SeaOf(const Point& point, const SpectrumModel& model) {
  return {.waves = WindSea{.wind_speed_10m = point.wind_speed, .fetch = point.fetch, .model = &model}};
}

SmallSlopeUncertainty ClosedFormAt(const Point& point, const SpectrumModel& model) {
  return ClosedForm(SeaState(SeaOf(point, model)),
                    {.incidence = RadiansOfDegrees(point.incidence), .footprint = point.footprint}, kRefractiveIndex);
}

std::string FetchText(double fetch) {
  return std::isinf(fetch) ? "fully developed" : absl::StrFormat("%g", fetch / 1e3);
}

// The value below which the fraction `part` of `values` lies.
double Quantile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1) + 0.5)];
}

RatioSummary Summarize(const std::vector<double>& ratios) {
  return {Quantile(ratios, 0.5), Quantile(ratios, 0.05), Quantile(ratios, 0.95), Quantile(ratios, 0),
          Quantile(ratios, 1)};
}

RatioSummary CompareInClosedForm(Study& study) {
  const std::vector<Point> points = SurveyDomain();
  std::vector<SmallSlopeUncertainty> apel(points.size()), elfouhaily(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    apel[i] = ClosedFormAt(points[i], kApelModel);
    elfouhaily[i] = ClosedFormAt(points[i], kElfouhailyModel);
  });
  DataTable table{
      .name = "spectra_closed_form",
      .title =
          "2 sigma values in closed form for both spectra, beam along the wind: angles in degrees, THU and "
          "TVU per m of depth",
      .columns = {"wind_speed_m_s", "fetch_km", "incidence_deg", "footprint_m", "apel_along_deg",
                  "elfouhaily_along_deg", "apel_cross_deg", "elfouhaily_cross_deg", "apel_thu_per_depth",
                  "elfouhaily_thu_per_depth", "apel_tvu_per_depth", "elfouhaily_tvu_per_depth", "thu_ratio"},
      .on_the_page = false};
  std::vector<double> along, cross, thu, tvu;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SmallSlopeUncertainty &a = apel[i], &e = elfouhaily[i];
    along.push_back(e.refraction_along_wind / a.refraction_along_wind);
    cross.push_back(e.refraction_cross_wind / a.refraction_cross_wind);
    thu.push_back(e.thu_per_depth / a.thu_per_depth);
    if (a.tvu_per_depth > 0) tvu.push_back(e.tvu_per_depth / a.tvu_per_depth);
    const auto degrees = DegreesOfRadians;
    table.Add(points[i].wind_speed, FetchText(points[i].fetch), points[i].incidence, points[i].footprint,
              degrees(a.refraction_along_wind), degrees(e.refraction_along_wind), degrees(a.refraction_cross_wind),
              degrees(e.refraction_cross_wind), a.thu_per_depth, e.thu_per_depth, a.tvu_per_depth, e.tvu_per_depth,
              thu.back());
  }
  study.tables.push_back(std::move(table));

  DataTable summary{.name = "spectra_ratios",
                    .title = absl::StrFormat("The ratio of Elfouhaily's 2 sigma value to Apel's at %d points: winds of "
                                             "2-15 m/s, fetches from 1 km, 0-20 degrees, footprints of 0.25-2 m",
                                             static_cast<int>(points.size())),
                    .columns = {"quantity", "least", "percent_5", "median", "percent_95", "greatest"}};
  for (const auto& [name, ratios] : {std::pair{"refraction along wind", &along},
                                     {"refraction cross wind", &cross},
                                     {"THU", &thu},
                                     {"TVU, off nadir", &tvu}}) {
    const RatioSummary r = Summarize(*ratios);
    summary.Add(name, r.least, r.low, r.median, r.high, r.greatest);
    study.comparisons.push_back(
        {.quantity = absl::StrFormat("%s, Elfouhaily over Apel, median", name),
         .unit = "1",
         .ours = r.median,
         .basis = absl::StrFormat("the uncertainty of the model: %.2f to %.2f at nine of ten points", r.low, r.high)});
  }
  study.tables.push_back(std::move(summary));
  return Summarize(thu);
}

void CompareByMonteCarlo(const StudyOptions& options, Study& study) {
  constexpr double kDepth = 10;  // m
  const Effort effort{.realizations = options.quick ? 400 : 3000, .most_realizations = options.quick ? 400 : 3000};
  DataTable table{
      .name = "spectra_monte_carlo",
      .title =
          "THU and TVU at 10 m by Monte Carlo for both spectra, beam along the wind, with "
          "standard errors; the ratio of THU, and that in closed form",
      .columns = {"wind_speed_m_s", "fetch_km", "incidence_deg", "footprint_m", "apel_thu_m",
                  "apel_thu_standard_error_m", "elfouhaily_thu_m", "elfouhaily_thu_standard_error_m", "apel_tvu_m",
                  "apel_tvu_standard_error_m", "elfouhaily_tvu_m", "elfouhaily_tvu_standard_error_m", "thu_ratio",
                  "thu_ratio_standard_error", "thu_ratio_closed_form"}};
  std::uint32_t cell = 0;
  for (const Point& point : {Point{3, 1e4, 20, 0.5},
                             {6, kFullyDeveloped, 0, 0.5},
                             {6, kFullyDeveloped, 20, 0.5},
                             {10, kFullyDeveloped, 20, 0.5},
                             {10, 1e4, 20, 2}}) {
    BeamUncertainty by_spectrum[2];
    for (const SpectrumModel* model : {&kApelModel, &kElfouhailyModel}) {
      SeaCase sea_case;
      sea_case.sea = SeaOf(point, *model);
      sea_case.beams = {{.incidence = RadiansOfDegrees(point.incidence), .footprint = point.footprint}};
      sea_case.depths = {kDepth};
      by_spectrum[model == &kElfouhailyModel] = Simulate(sea_case, effort, options.seed, cell++).beams[0];
    }
    const auto& [apel, elfouhaily] = by_spectrum;
    const double ratio = elfouhaily.thu[0].value / apel.thu[0].value;
    const double ratio_error = ratio * std::hypot(elfouhaily.thu[0].standard_error / elfouhaily.thu[0].value,
                                                  apel.thu[0].standard_error / apel.thu[0].value);
    const double closed_form =
        ClosedFormAt(point, kElfouhailyModel).thu_per_depth / ClosedFormAt(point, kApelModel).thu_per_depth;
    table.Add(point.wind_speed, FetchText(point.fetch), point.incidence, point.footprint, apel.thu[0],
              elfouhaily.thu[0], apel.tvu[0], elfouhaily.tvu[0], ratio, ratio_error, closed_form);
  }
  study.tables.push_back(std::move(table));
}

}  // namespace

RatioSummary CompareSpectra(const StudyOptions& options, Study& study) {
  const RatioSummary thu = CompareInClosedForm(study);
  CompareByMonteCarlo(options, study);
  return thu;
}

}  // namespace albtpu
