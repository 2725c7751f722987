// One state of the sea in numbers that an oceanographer checks, and their sources.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "annotate/seas/sea_timeline.h"
#include "sea/response/footprint_kernel.h"
#include "sea/spectra/described_sea.h"
#include "sea/spectra/sea_error.h"

namespace albtpu::annotate {

struct SeaFacts {
  std::optional<double> time;          // s since 1970
  double significant_wave_height = 0;  // m, of the given or measured waves, without the tail
  double peak_period = 0;              // s; 0 without waves
  double axis = 0;                     // degree from north, 0 to 180: along it most of the energy travels, either way
  DescribedSea sea;
  std::string_view wind_speed_of;      // "user", "file", "waves" (derived), "unknown" (taken as calm)
  std::string_view wind_direction_of;  // "user", "file", "waves", "unknown"; "none" in a calm
  std::string tail;                    // the rule; "none" also where nothing is joined
  double share_measured = 0;           // of the slope variance under a vertical beam of 0.6 m
  std::optional<SeaError> error;       // of the same; none where the sea is complete
};

SeaFacts FactsOf(const SeaTimeline& seas, std::size_t record);
nlohmann::ordered_json Json(const SeaFacts& facts);

// One line: time, height, period, wind and its source, tail, share of the measured waves, standard error of 2 sigma.
std::string Text(const SeaFacts& facts);

// Slopes, which decide the uncertainty.
struct SlopeFacts {
  struct Footprint {
    double diameter;                            // m
    double slope_variance;                      // of the slope averaged over it, any direction
    double refraction_along, refraction_cross;  // degree, 2 sigma, at nadir, on the axes of the sea
  };
  double mean_square_slope = 0, below_11 = 0,
         below_20 = 0;  // of waves with wavenumbers below 11 and 20 rad/m
  std::vector<Footprint> footprints;
  // 2 sigma at nadir and 0.6 m along the axis x, degree, with each rule of kTailRules. Empty where no tail is joined.
  std::vector<double> by_tail_rule;
};

// For many seas.
class SlopeSurvey {
 public:
  static constexpr double kDiameters[] = {0.2, 0.6, 1, 2, 5};  // m

  explicit SlopeSurvey(double index);  // of the water

  SlopeFacts operator()(const SeaTimeline& seas, std::size_t record) const;

 private:
  double index_;
  std::vector<FootprintKernel> footprints_, one_footprint_;
};

nlohmann::ordered_json Json(const SlopeFacts& facts);

// The source of the states: file, format, place, and what the file does not state.
nlohmann::ordered_json SeasHeadJson(const SeaTimeline& seas);

// The seas of a run, for a summary and for the user: the first and the last of the records that were used.
nlohmann::ordered_json SeasJson(const SeaTimeline& seas, std::size_t first, std::size_t last);
std::vector<std::string> SeasNotes(const SeaTimeline& seas, std::size_t first, std::size_t last);

}  // namespace albtpu::annotate
