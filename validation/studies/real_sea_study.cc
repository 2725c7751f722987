#include "validation/studies/real_sea_study.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "sea/sea_state.h"
#include "validation/studies/observed_seas.h"
#include "validation/studies/spectra_comparison.h"

namespace albtpu {
namespace {

constexpr double kFullyDeveloped = std::numeric_limits<double>::infinity();

SeaState Sea(const SpectrumModel& model, double wind_speed, double fetch = kFullyDeveloped) {
  return SeaState({.waves = WindSea{.wind_speed_10m = wind_speed, .fetch = fetch, .model = &model}});
}

double WaveHeight(const SeaState& sea) { return 4 * std::sqrt(ElevationVariance(sea)); }

// In the order of the tables' columns.
constexpr const SpectrumModel* kSpectra[] = {&kApelModel, &kElfouhailyModel};

// The winds of Cox and Munk, and that from which on Elfouhaily's sea has short waves: m/s.
constexpr int kLeastObserved = 1, kGreatestObserved = 14, kShortWavesFrom = 3;

// Of the total mean square slope from Cox and Munk's line, over every m/s of their winds from `first` on.
double RmsDepartureOfSlope(const SpectrumModel& model, int first) {
  double squares = 0;
  for (int wind = first; wind <= kGreatestObserved; ++wind) {
    const double departure = SlopeCovariance(Sea(model, wind)).trace() - CoxMunkTotal(wind).mean_square;
    squares += departure * departure;
  }
  return std::sqrt(squares / (kGreatestObserved - first + 1));
}

void CompareSlopes(Study& study) {
  DataTable table{.name = "real_sea_slopes",
                  .title = "Mean square slope of fully developed seas beside Cox and Munk (1954)",
                  .columns = {"wind_speed_m_s", "cox_munk_along", "apel_along", "elfouhaily_along",
                              "cox_munk_cross", "apel_cross", "elfouhaily_cross"},
                  .rows = {}};
  const auto compare = [&](const SpectrumModel& model, double wind, const char* direction, double ours,
                           const ObservedSlope& observed) {
    study.comparisons.push_back(
        {.quantity =
             absl::StrFormat("Mean square slope %s, %g m/s, %s", direction, wind, std::string(model.author)),
         .unit = "1",
         .published = observed.mean_square,
         .ours = ours,
         .verdict = std::abs(ours - observed.mean_square) <= 2 * observed.scatter ? Verdict::kAgrees
                                                                                  : Verdict::kDiffers,
         .basis =
             absl::StrFormat("within %g, two standard deviations of Cox and Munk's observations about their "
                             "line",
                             2 * observed.scatter)});
  };
  for (int wind = 1; wind <= 15; ++wind) {
    const ObservedSlope along = CoxMunkAlongWind(wind), cross = CoxMunkCrossWind(wind);
    std::vector<Cell> row_along = {along.mean_square}, row_cross = {cross.mean_square};
    for (const SpectrumModel* model : kSpectra) {
      const Eigen::Matrix2d slopes = SlopeCovariance(Sea(*model, wind));
      row_along.push_back(slopes(0, 0));
      row_cross.push_back(slopes(1, 1));
      if (wind == 1 || wind == 2 || wind == 5 || wind == 10 || wind == 14) {
        compare(*model, wind, "along the wind", slopes(0, 0), along);
        compare(*model, wind, "across the wind", slopes(1, 1), cross);
      }
    }
    std::vector<Cell> row = {static_cast<double>(wind)};
    row.insert(row.end(), row_along.begin(), row_along.end());
    row.insert(row.end(), row_cross.begin(), row_cross.end());
    table.rows.push_back(std::move(row));
  }
  study.tables.push_back(std::move(table));
  for (const SpectrumModel* model : kSpectra) {
    const double scatter = CoxMunkTotal(1).scatter;
    for (const auto& [first, winds] :
         {std::pair{kLeastObserved, "all winds that were observed, those too below 3 m/s"},
          std::pair{
              kShortWavesFrom,
              "only from 3 m/s on: in lighter wind Elfouhaily's sea has no short waves and is too steep"}}) {
      const double rms = RmsDepartureOfSlope(*model, first);
      study.comparisons.push_back(
          {.quantity =
               absl::StrFormat("Mean square slope, rms departure from Cox and Munk over %d-%d m/s, %s", first,
                               kGreatestObserved, std::string(model->author)),
           .unit = "1",
           .published = scatter,
           .ours = rms,
           .verdict = rms <= scatter ? Verdict::kAgrees : Verdict::kDiffers,
           .basis = absl::StrFormat(
               "no more than the observations' own standard deviation about the line; %s", winds)});
    }
  }
}

void CompareHeights(Study& study) {
  DataTable table{
      .name = "real_sea_heights",
      .title =
          "Significant wave height of fully developed seas beside Pierson and Moskowitz (1964), their wind "
          "taken from 10 m to 19.5 m by a logarithmic profile, and left as it is",
      .columns = {"wind_speed_m_s", "pierson_moskowitz_m", "pierson_moskowitz_wind_as_it_is_m", "apel_m",
                  "elfouhaily_m"},
      .rows = {}};
  for (int wind = 1; wind <= 15; ++wind) {
    const double observed = PiersonMoskowitzWaveHeightOf(wind);
    std::vector<Cell> row = {static_cast<double>(wind), observed, PiersonMoskowitzWaveHeight(wind)};
    for (const SpectrumModel* model : kSpectra) {
      const double height = WaveHeight(Sea(*model, wind));
      row.push_back(height);
      if (wind == 5 || wind == 10) {
        study.comparisons.push_back(
            {.quantity = absl::StrFormat("Significant wave height, %d m/s, fully developed, %s", wind,
                                         std::string(model->author)),
             .unit = "m",
             .published = observed,
             .ours = height,
             .basis = "Pierson and Moskowitz give no scatter; of their wind at 19.5 m, not at 10 m"});
      }
    }
    table.rows.push_back(std::move(row));
  }
  study.tables.push_back(std::move(table));
}

void CompareHeightsByFetch(Study& study) {
  DataTable table{.name = "real_sea_heights_by_fetch",
                  .title = "Significant wave height by fetch beside JONSWAP (Hasselmann et al., 1973)",
                  .columns = {"wind_speed_m_s", "fetch_km", "jonswap_m", "apel_m", "elfouhaily_m"},
                  .rows = {}};
  for (const double wind : {5.0, 10.0, 15.0}) {
    for (const double kilometres : {1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0}) {
      const double observed = JonswapWaveHeight(wind, 1e3 * kilometres);
      std::vector<Cell> row = {wind, kilometres, observed};
      for (const SpectrumModel* model : kSpectra) {
        const double height = WaveHeight(Sea(*model, wind, 1e3 * kilometres));
        row.push_back(height);
        if (wind == 10 && (kilometres == 1 || kilometres == 10 || kilometres == 100)) {
          study.comparisons.push_back(
              {.quantity = absl::StrFormat("Significant wave height, 10 m/s, fetch %g km, %s", kilometres,
                                           std::string(model->author)),
               .unit = "m",
               .published = observed,
               .ours = height,
               .basis = "a law fitted to scattered observations: no scatter is stated to judge by"});
        }
      }
      table.rows.push_back(std::move(row));
    }
  }
  study.tables.push_back(std::move(table));
}

}  // namespace

absl::StatusOr<Study> RealSeaStudy(const StudyOptions& options) {
  Study study;
  study.id = "real_sea";
  study.title = "The real sea: slopes, heights, and another spectrum";
  CompareSlopes(study);
  CompareHeights(study);
  CompareHeightsByFetch(study);
  const RatioSummary thu = CompareSpectra(options, study);
  study.paragraphs = {
      "Two spectra stand beside what was measured: Apel's, with which the paper and our tables are made, and "
      "the unified one of Elfouhaily et al. (1997), with its own spreading, its own fetch law and friction "
      "velocity by the drag law of Wu (1982).",
      absl::StrFormat(
          "Slopes: Cox and Munk (1954), clean surface, along the wind 0.000 + 3.16e-3 U +- 0.004, across "
          "0.003 + 1.92e-3 U +- 0.002, wind at 12.5 m. Apel's sea is steeper, by a factor of 1.6 to 2.7 in "
          "mean square slope from 3 m/s on: its capillary-gravity resonance puts too much power into waves "
          "of about a centimetre. A footprint averages them away, but the biases feel them. Elfouhaily's sea "
          "was fitted to these observations. In light wind its long waves alone, whose level does not know "
          "of the short ones, are steeper than what was seen, most along the wind. So it is the range of "
          "winds that decides whether it is within their scatter, %.4f: the rms departure of its total mean "
          "square slope is %.4f from %d m/s on and %.4f over all winds from %d m/s.",
          CoxMunkTotal(1).scatter, RmsDepartureOfSlope(kElfouhailyModel, kShortWavesFrom), kShortWavesFrom,
          RmsDepartureOfSlope(kElfouhailyModel, kLeastObserved), kLeastObserved),
      "Heights: Pierson and Moskowitz (1964), Hs = 0.21 U^2 / g with the wind at 19.5 m, and by fetch "
      "JONSWAP, Hs = 1.6e-3 (g x / U^2)^(1/2) U^2 / g with the wind at 10 m, to where it meets the fully "
      "developed sea. At short fetch Apel's waves are 2-3 times too low, because its level A does not depend "
      "on fetch; Elfouhaily's are on JONSWAP within a few per cent to 10 km.",
      absl::StrFormat(
          "What it does to a beam: with Elfouhaily's spectrum THU is %.2f (median) of what it is with "
          "Apel's, %.2f to %.2f in nine of ten points of the survey domain and %.2f to %.2f in all. The "
          "spectra agree best where surveys mostly are, in developed seas under footprints below a metre, in "
          "spite of their different mean square slopes: what the footprint lets through is alike. At a fetch "
          "of 1 km Apel's low waves make a THU about half as great: tables made with it are not conservative "
          "there. This is the uncertainty of the model itself, which no number of realizations reduces and "
          "no standard error in a table holds.",
          thu.median, thu.low, thu.high, thu.least, thu.greatest)};
  study.figures = {
      {.name = "real_sea_slopes",
       .caption = "Mean square slope along and across the wind, fully developed. The bands are one standard "
                  "deviation of Cox and Munk's observations."},
      {.name = "real_sea_heights",
       .caption = "Significant wave height: left by wind, fully developed; right by fetch at 10 m/s."},
      {.name = "spectra_thu",
       .caption = "THU of Elfouhaily's sea over that of Apel's by wind, closed form, 20 degrees: for "
                  "footprints (fully developed, left) and fetches (footprint 0.5 m, right)."}};
  return study;
}

}  // namespace albtpu
