#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "sea/angle.h"
#include "sea/response/closed_form.h"
#include "validation/studies/closed_form_ratio.h"
#include "validation/studies/studies.h"

namespace albtpu {
namespace {

constexpr double kDepth = 10;  // m

struct Domain {
  std::vector<double> wind_speeds, fetches, footprints;  // m/s, m, m
  int realizations;
};
const Domain kWhole = {{1, 2, 3, 5, 7, 10, 12.5, 15}, {100, 3000, kFullyDeveloped}, {0.1, 0.4, 1.5, 5}, 400};
const Domain kQuick = {{1, 5, 10, 15}, {100, kFullyDeveloped}, {0.1, 0.7, 5}, 100};

// Degrees. All incidences along the wind, and the largest one also across it.
struct Direction {
  double incidence, azimuth;
};
const std::vector<Direction> kDirections = {{0, 0}, {5, 0}, {10, 0}, {15, 0}, {20, 0}, {25, 0}, {25, 90}};

struct MapPart {
  double wind_speed, fetch, footprint;
  SeaCaseRatios ratios;  // beams in the order of kDirections
  bool is_judged() const { return ratios.seen_fraction >= kMinSeenFraction; }
};

std::vector<MapPart> MakeMap(const Domain& domain, std::uint64_t seed) {
  std::vector<MapPart> map;
  for (const double wind_speed : domain.wind_speeds) {
    for (const double fetch : domain.fetches) {
      for (const double footprint : domain.footprints) {
        SeaCase sea_case;
        sea_case.sea.waves = WindSea{.wind_speed_10m = wind_speed, .fetch = fetch};
        sea_case.depths = {kDepth};
        for (const Direction& direction : kDirections) {
          sea_case.beams.push_back({.incidence = RadiansOfDegrees(direction.incidence),
                                    .azimuth = RadiansOfDegrees(direction.azimuth),
                                    .footprint = footprint});
        }
        const auto cell = static_cast<std::uint32_t>(map.size());
        map.push_back({wind_speed, fetch, footprint, CompareWithClosedForm(sea_case, domain.realizations, seed, cell)});
      }
    }
  }
  return map;
}

// The mean of a ratio over the seas and footprints of one wind, which have independent surfaces.
Estimate MeanRatio(const std::vector<MapPart>& map, double wind_speed, std::size_t direction,
                   Estimate ClosedFormRatio::*quantity) {
  Estimate mean;
  double count = 0;
  for (const MapPart& part : map) {
    if (part.wind_speed != wind_speed || !part.is_judged()) continue;
    const Estimate& ratio = part.ratios.beams[direction].*quantity;
    mean.value += ratio.value;
    mean.standard_error += ratio.standard_error * ratio.standard_error;
    ++count;
  }
  return {mean.value / count, std::sqrt(mean.standard_error) / count};
}

// 1 - ratio of THU = constant + mss (at_nadir + with_incidence (theta / 20 degrees)^2): the nonlinear part of Snell's
// law is of the order of the slopes squared, and even in the incidence.
Eigen::Vector3d FitDeparture(const std::vector<const MapPart*>& parts) {
  const auto rows = static_cast<Eigen::Index>(parts.size() * kDirections.size());
  Eigen::MatrixX3d terms(rows, 3);
  Eigen::VectorXd departures(rows);
  Eigen::Index row = 0;
  for (const MapPart* part : parts) {
    for (std::size_t b = 0; b < kDirections.size(); ++b, ++row) {
      const double slopes = part->ratios.mean_square_slope, turn = kDirections[b].incidence / 20;
      terms.row(row) << 1, slopes, slopes * turn * turn;
      departures[row] = 1 - part->ratios.beams[b].thu.value;
    }
  }
  return terms.colPivHouseholderQr().solve(departures);
}

// With jackknife standard errors, leaving out one sea and footprint at a time, because the beams over one sea share
// its surfaces.
std::vector<Estimate> FitDepartureWithErrors(const std::vector<MapPart>& map) {
  std::vector<const MapPart*> parts;
  for (const MapPart& part : map)
    if (part.is_judged()) parts.push_back(&part);
  const Eigen::Vector3d fit = FitDeparture(parts);
  const double count = static_cast<double>(parts.size());
  Eigen::Array3d variance = Eigen::Array3d::Zero();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::vector<const MapPart*> others = parts;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    variance += (count - 1) / count * (FitDeparture(others) - fit).array().square();
  }
  return {{fit[0], std::sqrt(variance[0])}, {fit[1], std::sqrt(variance[1])}, {fit[2], std::sqrt(variance[2])}};
}

// The theoretical value of at_nadir as the slopes vanish; see "The third order in slope" in docs/physics.md. A slope
// m deflects a ray by the tangent g m - c m |m|^2, so that Gaussian slopes with the variances sx^2 and sy^2 lower the
// gain along x by (3 sx^2 + sy^2) c / g and along y by (sx^2 + 3 sy^2) c / g; in this sea the variances are in the
// ratio 7 to 5.
double ThirdOrderAtNadir(double n) {
  const double g = 1 - 1 / n;
  const double c = 1.0 / 3 - 1 / (2 * n) + 1 / (6 * n * n * n) - g * g * g / 3;
  const double x = 7.0 / 12, y = 5.0 / 12;
  return (x * (3 * x + y) + y * (x + 3 * y)) * c / g;
}

struct Tally {
  int within = 0, all = 0;
  double max_excess = -std::numeric_limits<double>::infinity();  // in standard errors
};

Tally CountWithin(const std::vector<MapPart>& map) {
  Tally tally;
  for (const MapPart& part : map) tally.all += part.is_judged() ? 3 * static_cast<int>(kDirections.size()) : 0;
  const double k = StandardErrorsFor(tally.all);
  for (const MapPart& part : map) {
    if (!part.is_judged()) continue;
    for (const ClosedFormRatio& beam : part.ratios.beams) {
      for (const Estimate& ratio : {beam.along, beam.cross, beam.thu}) {
        const double excess = ExcessInStandardErrors(ratio, beam.allowed);
        tally.within += excess <= k;
        tally.max_excess = std::max(tally.max_excess, excess);
      }
    }
  }
  return tally;
}

DataTable WholeMap(const std::vector<MapPart>& map) {
  DataTable table{
      .name = "closed_form_map",
      .title = "Ratio of Monte Carlo to closed form at every node of the domain, depth 10 m",
      .columns = {"wind_speed_m_s", "fetch_m", "footprint_m", "incidence_deg", "azimuth_deg", "along_ratio",
                  "along_ratio_se", "cross_ratio", "cross_ratio_se", "thu_ratio", "thu_ratio_se", "tvu_ratio",
                  "tvu_ratio_se", "least_ratio", "most_ratio", "mean_square_slope", "seen_fraction", "judged"},
      .on_the_page = false};
  for (const MapPart& part : map) {
    for (std::size_t b = 0; b < kDirections.size(); ++b) {
      const ClosedFormRatio& beam = part.ratios.beams[b];
      table.Add(part.wind_speed, part.fetch, part.footprint, kDirections[b].incidence, kDirections[b].azimuth,
                beam.along, beam.cross, beam.thu, beam.tvu, 1 - beam.allowed, 1 + kDiscretizationError,
                part.ratios.mean_square_slope, part.ratios.seen_fraction, part.is_judged() ? "yes" : "no");
    }
  }
  return table;
}

DataTable MeanMap(const std::vector<MapPart>& map, const Domain& domain) {
  DataTable table{
      .name = "closed_form_map_mean",
      .title = "Ratio of Monte Carlo to closed form, mean over fetches and footprints",
      .columns = {"wind_speed_m_s", "incidence_deg", "azimuth_deg", "along_ratio", "along_ratio_se", "cross_ratio",
                  "cross_ratio_se", "thu_ratio", "thu_ratio_se", "tvu_ratio", "tvu_ratio_se"}};
  for (const double wind_speed : domain.wind_speeds) {
    for (std::size_t b = 0; b < kDirections.size(); ++b) {
      const auto mean = [&](Estimate ClosedFormRatio::*quantity) { return MeanRatio(map, wind_speed, b, quantity); };
      table.Add(wind_speed, kDirections[b].incidence, kDirections[b].azimuth, mean(&ClosedFormRatio::along),
                mean(&ClosedFormRatio::cross), mean(&ClosedFormRatio::thu), mean(&ClosedFormRatio::tvu));
    }
  }
  return table;
}

void Compare(const std::vector<MapPart>& map, const Domain& domain, Study& study) {
  const Tally tally = CountWithin(map);
  study.comparisons.push_back(
      {.quantity = absl::StrCat("Refraction and THU within the bounds set by Snell's law, of ", tally.all),
       .unit = "ratios",
       .ours = static_cast<double>(tally.within),
       .verdict = AgreesIf(tally.within == tally.all),
       .basis = absl::StrFormat(
           "all at most 0.015 + 0.3 mss + 0.02 theta/20 degrees below 1 and 0.005 above it, besides %.1f "
           "standard errors, which chance exceeds in one such map of twenty; the worst is %.1f beyond",
           StandardErrorsFor(tally.all), tally.max_excess)});
  const std::vector<Estimate> fit = FitDepartureWithErrors(map);
  study.comparisons.push_back(
      {.quantity = "THU below the closed form as the slopes vanish",
       .unit = "1",
       .ours = fit[0].value,
       .standard_error = fit[0].standard_error,
       .verdict = AgreesIf(std::abs(fit[0].value) <= kDiscretizationError + 3 * fit[0].standard_error),
       .basis = "zero within three standard errors and 0.005, the accuracy for which grid, patch and rays "
                "are chosen"});
  const auto report = [&](const char* quantity, const Estimate& ours, const std::string& basis) {
    study.comparisons.push_back(
        {.quantity = quantity, .unit = "1", .ours = ours.value, .standard_error = ours.standard_error, .basis = basis});
  };
  report("THU below the closed form, per unit of mean square slope at nadir", fit[1],
         absl::StrFormat("Snell's law to third order in slope gives %.3f as the slopes vanish",
                         ThirdOrderAtNadir(kRefractiveIndex)));
  report("THU below the closed form, additional amount per unit of mean square slope at 20 degrees", fit[2],
         "a fit in the square of the incidence; jackknife standard error");
  report("THU, ratio of Monte Carlo to closed form, 1 m/s at nadir",
         MeanRatio(map, domain.wind_speeds.front(), 0, &ClosedFormRatio::thu), "mean over fetches and footprints");
  report("THU, ratio of Monte Carlo to closed form, 15 m/s at 25 degrees along the wind",
         MeanRatio(map, domain.wind_speeds.back(), 5, &ClosedFormRatio::thu), "mean over fetches and footprints");
}

}  // namespace

absl::StatusOr<Study> ClosedFormMapStudy(const StudyOptions& options) {
  const Domain& domain = options.quick ? kQuick : kWhole;
  const std::vector<MapPart> map = MakeMap(domain, options.seed);
  const std::vector<Estimate> fit = FitDepartureWithErrors(map);
  const auto judged = std::count_if(map.begin(), map.end(), [](const MapPart& part) { return part.is_judged(); });

  Study study;
  study.id = "closed_form";
  study.title = "The closed form over the whole domain";
  study.paragraphs = {
      absl::StrFormat(
          "The small-slope theory is compared with the Monte Carlo over the domain of a survey: winds of 1 "
          "to 15 m/s, fetches from 100 m to fully developed, footprints of 0.1 to 5 m, incidences of 0 to 25 "
          "degrees, with %d independent surfaces for each of %d combinations of sea and footprint.",
          domain.realizations, map.size()),
      absl::StrFormat("The theory fails slowly and to one side, because it is linear in slope and Snell's law is not. "
                      "Over all seas and footprints the THU of the Monte Carlo is below the theory by %.3f (+- %.3f) "
                      "times the mean square slope at nadir and by another %.3f (+- %.3f) times it at 20 degrees, "
                      "growing with the square of the incidence. The difference reaches 1 %% at a mean square slope of "
                      "%.3f at nadir and of %.3f at 25 degrees.",
                      fit[1].value, fit[1].standard_error, fit[2].value, fit[2].standard_error, 0.01 / fit[1].value,
                      0.01 / (fit[1].value + fit[2].value * std::pow(25.0 / 20, 2))),
      absl::StrFormat(
          "Vertical errors are of second order in slope at nadir, where the theory has none, and the second "
          "order still contributes at 5 degrees: there the TVU of the Monte Carlo is %.3f of the theory's in "
          "the lightest wind. At 25 degrees in the strongest wind it is %.3f. %d of the %d combinations of "
          "sea and footprint are judged; in the others the footprint averages the waves down to less than "
          "3e-5 of their mean square slope, and the discretization is not refined for what remains of them.",
          MeanRatio(map, domain.wind_speeds.front(), 1, &ClosedFormRatio::tvu).value,
          MeanRatio(map, domain.wind_speeds.back(), 5, &ClosedFormRatio::tvu).value, judged, map.size())};
  Compare(map, domain, study);
  study.tables = {MeanMap(map, domain), WholeMap(map)};
  study.figures = {
      {.name = "closed_form_map",
       .caption = "Ratio of the THU of the Monte Carlo to that of the closed form, mean over fetches and "
                  "footprints, and its standard error, by wind and incidence (beam along the wind)."},
      {.name = "closed_form_departure",
       .caption = "Ratio of the THU of the Monte Carlo to that of the closed form for each sea and "
                  "footprint, as a function of the mean square slope, at nadir and at 25 degrees. The shaded "
                  "range is the departure that Snell's law explains."}};
  return study;
}

}  // namespace albtpu
