#include "validation/studies/real_sea_study.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "sea/sea_state.h"
#include "sea/spectra/wave_spectrum.h"
#include "sea/spectra/wind_sea.h"
#include "validation/studies/spectra_comparison.h"
#include "validation/studies/studies.h"

namespace albtpu {
namespace {

constexpr double kAnemometerOfCoxAndMunk = 12.5;        // m
constexpr double kAnemometerOfPiersonMoskowitz = 19.5;  // m

}  // namespace

ObservedSlope CoxMunkAlongWind(double wind_speed_10m) {
  return {0.000 + 3.16e-3 * WindSpeedAt(kAnemometerOfCoxAndMunk, wind_speed_10m), 0.004};
}

ObservedSlope CoxMunkCrossWind(double wind_speed_10m) {
  return {0.003 + 1.92e-3 * WindSpeedAt(kAnemometerOfCoxAndMunk, wind_speed_10m), 0.002};
}

ObservedSlope CoxMunkTotal(double wind_speed_10m) {
  return {0.003 + 5.12e-3 * WindSpeedAt(kAnemometerOfCoxAndMunk, wind_speed_10m), 0.004};
}

double PiersonMoskowitzWaveHeight(double wind_speed_19_5m) {
  constexpr double kAlpha = 8.1e-3, kBeta = 0.74;
  return 2 * std::sqrt(kAlpha / kBeta) * wind_speed_19_5m * wind_speed_19_5m / kGravity;
}

double PiersonMoskowitzWaveHeightOf(double wind_speed_10m) {
  return PiersonMoskowitzWaveHeight(WindSpeedAt(kAnemometerOfPiersonMoskowitz, wind_speed_10m));
}

double JonswapWaveHeight(double wind_speed_10m, double fetch) {
  const double scale = wind_speed_10m * wind_speed_10m / kGravity;  // m
  return std::min(4 * std::sqrt(1.6e-7 * fetch / scale) * scale, PiersonMoskowitzWaveHeightOf(wind_speed_10m));
}

namespace {

SeaState Sea(const SpectrumModel& model, double wind_speed, double fetch = kFullyDeveloped) {
  return SeaState({.waves = WindSea{.wind_speed_10m = wind_speed, .fetch = fetch, .model = &model}});
}

double WaveHeight(const SeaState& sea) { return 4 * std::sqrt(ElevationVariance(sea)); }

// In the order of the tables' columns.
constexpr const SpectrumModel* kSpectra[] = {&kApelModel, &kElfouhailyModel};

// The range of winds observed by Cox and Munk, and the lowest wind at which Elfouhaily's sea has short waves, m/s.
constexpr int kMinObserved = 1, kMaxObserved = 14, kShortWavesFrom = 3;

// The rms departure of the total mean square slope from Cox and Munk's line, over their winds from `first` on in
// steps of 1 m/s.
double RmsDepartureOfSlope(const SpectrumModel& model, int first) {
  double squares = 0;
  for (int wind = first; wind <= kMaxObserved; ++wind) {
    const double departure = SlopeCovariance(Sea(model, wind)).trace() - CoxMunkTotal(wind).mean_square;
    squares += departure * departure;
  }
  return std::sqrt(squares / (kMaxObserved - first + 1));
}

void CompareSlopes(Study& study) {
  DataTable table{.name = "real_sea_slopes",
                  .title = "Mean square slope of fully developed seas, compared with Cox and Munk (1954)",
                  .columns = {"wind_speed_m_s", "cox_munk_along", "apel_along", "elfouhaily_along", "cox_munk_cross",
                              "apel_cross", "elfouhaily_cross"}};
  const auto compare = [&](const SpectrumModel& model, double wind, const char* direction, double ours,
                           const ObservedSlope& observed) {
    study.comparisons.push_back(
        {.quantity = absl::StrFormat("Mean square slope %s, %g m/s, %s", direction, wind, std::string(model.author)),
         .unit = "1",
         .published = observed.mean_square,
         .ours = ours,
         .verdict = AgreesIf(std::abs(ours - observed.mean_square) <= 2 * observed.scatter),
         .basis = absl::StrFormat("within %g, two standard deviations of Cox and Munk's observations about their "
                                  "line",
                                  2 * observed.scatter)});
  };
  for (int wind = 1; wind <= 15; ++wind) {
    const ObservedSlope along = CoxMunkAlongWind(wind), cross = CoxMunkCrossWind(wind);
    std::vector<Cell> ours_along, ours_cross;
    for (const SpectrumModel* model : kSpectra) {
      const Eigen::Matrix2d slopes = SlopeCovariance(Sea(*model, wind));
      ours_along.push_back(slopes(0, 0));
      ours_cross.push_back(slopes(1, 1));
      if (wind == 1 || wind == 2 || wind == 5 || wind == 10 || wind == 14) {
        compare(*model, wind, "along the wind", slopes(0, 0), along);
        compare(*model, wind, "across the wind", slopes(1, 1), cross);
      }
    }
    table.Add(wind, along.mean_square, ours_along, cross.mean_square, ours_cross);
  }
  study.tables.push_back(std::move(table));
  for (const SpectrumModel* model : kSpectra) {
    const double scatter = CoxMunkTotal(1).scatter;
    for (const auto& [first, winds] :
         {std::pair{kMinObserved, "all observed winds, including those below 3 m/s"},
          std::pair{kShortWavesFrom,
                    "only from 3 m/s on: in lighter winds Elfouhaily's sea has no short waves and is too steep"}}) {
      const double rms = RmsDepartureOfSlope(*model, first);
      study.comparisons.push_back(
          {.quantity = absl::StrFormat("Mean square slope, rms departure from Cox and Munk over %d-%d m/s, %s", first,
                                       kMaxObserved, std::string(model->author)),
           .unit = "1",
           .published = scatter,
           .ours = rms,
           .verdict = AgreesIf(rms <= scatter),
           .basis =
               absl::StrFormat("no more than the standard deviation of the observations about the line; %s", winds)});
    }
  }
}

void CompareHeights(Study& study) {
  DataTable table{
      .name = "real_sea_heights",
      .title =
          "Significant wave height of fully developed seas, compared with Pierson and Moskowitz (1964), with "
          "the wind converted from 10 m to 19.5 m by a logarithmic profile, and unconverted",
      .columns = {"wind_speed_m_s", "pierson_moskowitz_m", "pierson_moskowitz_wind_as_it_is_m", "apel_m",
                  "elfouhaily_m"}};
  for (int wind = 1; wind <= 15; ++wind) {
    const double observed = PiersonMoskowitzWaveHeightOf(wind);
    std::vector<Cell> ours;
    for (const SpectrumModel* model : kSpectra) {
      const double height = WaveHeight(Sea(*model, wind));
      ours.push_back(height);
      if (wind == 5 || wind == 10) {
        study.comparisons.push_back(
            {.quantity = absl::StrFormat("Significant wave height, %d m/s, fully developed, %s", wind,
                                         std::string(model->author)),
             .unit = "m",
             .published = observed,
             .ours = height,
             .basis = "no verdict: Pierson and Moskowitz give no scatter; their wind is that at 19.5 m, not "
                      "at 10 m"});
      }
    }
    table.Add(wind, observed, PiersonMoskowitzWaveHeight(wind), ours);
  }
  study.tables.push_back(std::move(table));
}

void CompareHeightsByFetch(Study& study) {
  DataTable table{.name = "real_sea_heights_by_fetch",
                  .title = "Significant wave height by fetch, compared with JONSWAP (Hasselmann et al., 1973)",
                  .columns = {"wind_speed_m_s", "fetch_km", "jonswap_m", "apel_m", "elfouhaily_m"}};
  for (const double wind : {5.0, 10.0, 15.0}) {
    for (const double kilometres : {1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0}) {
      const double observed = JonswapWaveHeight(wind, 1e3 * kilometres);
      std::vector<Cell> ours;
      for (const SpectrumModel* model : kSpectra) {
        const double height = WaveHeight(Sea(*model, wind, 1e3 * kilometres));
        ours.push_back(height);
        if (wind == 10 && (kilometres == 1 || kilometres == 10 || kilometres == 100)) {
          study.comparisons.push_back(
              {.quantity = absl::StrFormat("Significant wave height, 10 m/s, fetch %g km, %s", kilometres,
                                           std::string(model->author)),
               .unit = "m",
               .published = observed,
               .ours = height,
               .basis = "no verdict: a law fitted to scattered observations, whose scatter is not stated"});
        }
      }
      table.Add(wind, kilometres, observed, ours);
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
      "Two spectra are compared with measurements: Apel's, with which the paper and our tables are made, and "
      "the unified one of Elfouhaily et al. (1997), which has its own spreading, its own fetch law and a "
      "friction velocity by the drag law of Wu (1982).",
      absl::StrFormat(
          "Slopes: Cox and Munk (1954), clean surface, give 0.000 + 3.16e-3 U +- 0.004 along the wind and "
          "0.003 + 1.92e-3 U +- 0.002 across it, with the wind at 12.5 m. From 3 m/s on, the mean square "
          "slope of Apel's sea is 1.6 to 2.7 times theirs: its capillary-gravity resonance puts too much "
          "power into waves of about a centimetre. A footprint averages these waves out, but the biases "
          "depend on them. Elfouhaily's sea was fitted to these observations. In light wind its long waves "
          "alone, whose level is independent of the short ones, are steeper than observed, mostly along the "
          "wind. Whether it is within the scatter of the observations, %.4f, therefore depends on the range "
          "of winds: the rms departure of its total mean square slope is %.4f from %d m/s on and %.4f over "
          "all winds from %d m/s.",
          CoxMunkTotal(1).scatter, RmsDepartureOfSlope(kElfouhailyModel, kShortWavesFrom), kShortWavesFrom,
          RmsDepartureOfSlope(kElfouhailyModel, kMinObserved), kMinObserved),
      "Heights: Pierson and Moskowitz (1964), Hs = 0.21 U^2 / g with the wind at 19.5 m; and by fetch "
      "JONSWAP, Hs = 1.6e-3 (g x / U^2)^(1/2) U^2 / g with the wind at 10 m, up to the fully developed sea. "
      "At short fetch Apel's waves are 2-3 times too low, because its level A does not depend on fetch; "
      "Elfouhaily's agree with JONSWAP within a few per cent up to 10 km.",
      absl::StrFormat(
          "Effect on a beam: THU with Elfouhaily's spectrum is %.2f (median) times that with Apel's, %.2f to "
          "%.2f at nine of ten points of the survey domain and %.2f to %.2f at all points. The spectra agree "
          "best where most surveys take place, in developed seas and with footprints below a metre, in spite "
          "of their different mean square slopes, because the footprint passes similar waves. At a fetch of "
          "1 km Apel's low waves make a THU about half as large: tables made with it are not conservative "
          "there. This is the uncertainty of the model itself, which no number of realizations reduces and "
          "which the standard errors in a table do not include.",
          thu.median, thu.low, thu.high, thu.least, thu.greatest)};
  study.figures = {
      {.name = "real_sea_slopes",
       .caption = "Mean square slope along and across the wind, fully developed. The bands are one standard "
                  "deviation of the observations of Cox and Munk."},
      {.name = "real_sea_heights",
       .caption = "Significant wave height: over wind, fully developed (left), and over fetch at 10 m/s (right)."},
      {.name = "spectra_thu",
       .caption = "Ratio of the THU of Elfouhaily's sea to that of Apel's over wind, closed form, 20 degrees: for "
                  "several footprints (fully developed, left) and several fetches (footprint 0.5 m, right)."}};
  return study;
}

}  // namespace albtpu
