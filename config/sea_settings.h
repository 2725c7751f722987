// The sea as flags and the survey file give it: the waves in a file or by their heights and periods, and the wind, the
// depth and the tail that go with them.
#pragma once

#include <array>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "config/key.h"
#include "sea/files/sea_file.h"
#include "sea/spectra/described_sea.h"
#include "sea/spectra/jonswap.h"

namespace albtpu::config {

// Waves of one peak: [[sea.waves]], or --hs and the like.
struct WaveSettings {
  std::optional<double> hs, tp, gamma, waves_from, spread;  // m, s, 1, degree, degree
  std::optional<std::string> spreading;                     // kSpreadings
};

// [sea]. Absent: not given. Directions are those of the compass, in degrees, from which wind and waves come.
struct SeaSettings {
  std::optional<std::string> file, place, time;  // time: one instant of the file; absent: that of each pulse
  std::optional<double> longest_gap;             // h
  std::optional<double> anemometer_height;       // m
  std::vector<JonswapWaves> waves;               // in place of a file
  WaveSettings wave_flags;                       // of which CompleteWaves() makes one of the waves
  std::optional<double> wind_speed, wind_from;   // m/s at 10 m; degree
  std::optional<double> fetch;                   // m, of the sea of a wind; infinity: fully developed
  std::optional<double> water_depth;             // m
  std::optional<std::string> tail;               // kTailRules
  std::optional<double> tail_from;               // Hz

  // Where no waves are given, a wind alone stands for the sea, and a table of winds answers.
  bool has_waves() const { return file.has_value() || !waves.empty(); }

  // For what a record of the file leaves open. Without waves.
  SeaDescription description() const;
  SeaFileOptions file_options() const;
};

inline constexpr std::array<std::string_view, 4> kTailRules = {"relax", "wind", "level", "none"};
inline constexpr std::array<std::string_view, 1> kSpreadings = {"mitsuyasu"};

// Degree. Waves from a storm that is 500 km wide and 5000 km away come from within 6 degrees, which is a standard
// deviation of 1.7. What is less was meant in radians.
inline constexpr double kNarrowestSpread = 1.6;

// clang-format off
inline constexpr std::array<Key<SeaSettings>, 11> kSeaKeys = {{
    {{"file", "--sea", Path{"the path of a file of the sea", "FILE"}, "",
      "Spectra or heights of the waves: NDBC, WAVEWATCH III, SWAN or CSV; several records are interpolated to the time "
      "of each pulse"},
     &SeaSettings::file},
    {{"time", "--sea-time", Text{"UTC, such as \"2020-06-08T03:50Z\"", "TIME"}, "the time of each pulse",
      "The instant of the file for all pulses, UTC, such as 2020-06-08T03:50Z"},
     &SeaSettings::time},
    {{"place", "--sea-place", Text{"a name, or \"LAT,LON\"", "NAME|LAT,LON"}, "the file's only one",
      "The place of the file, if it has several: its name, or the nearest to a latitude and longitude"},
     &SeaSettings::place},
    {{"tail", "--tail", Word{kTailRules}, "relax",
      "Waves shorter than the file resolves: the wind's, from the level of the resolved ones by relax, wind or level; "
      "or none"},
     &SeaSettings::tail},
    {{"wind_speed", "--wind-speed", Number{0, 100, "m/s"}, "",
      "Wind speed at 10 m above the sea; 0 is a calm"},
     &SeaSettings::wind_speed},
    {{"wind_from", "--wind-from", Number{-360, 360, "degree"}, "",
      "Where the wind comes from, clockwise from true north"},
     &SeaSettings::wind_from},
    {{"water_depth", "--sea-depth", Number{0.1, 20000, "m"}, "as the file states; otherwise deep",
      "Depth of the water that the waves travel in"},
     &SeaSettings::water_depth},
    {{"tail_from", "--tail-from", Number{0.05, 10, "Hz"}, "up to where the waves can be trusted",
      "Where the tail begins"},
     &SeaSettings::tail_from},
    {{"longest_gap", "--sea-gap", Number{0, 240, "h"}, "2.5 times the median step, from 3 to 15",
      "The longest time between two records of the file that is interpolated"},
     &SeaSettings::longest_gap},
    {{"anemometer_height", "--anemometer-height", Number{1, 100, "m"}, "10",
      "Height of the winds in an NDBC file of meteorological data"},
     &SeaSettings::anemometer_height},
    {{"fetch", "--fetch", Number{0, std::numeric_limits<double>::infinity(), "m"}, "inf, a fully developed sea",
      "Fetch of the wind, where no waves are given"},
     &SeaSettings::fetch},
}};
inline constexpr std::array<Key<WaveSettings>, 6> kWaveKeys = {{
    {{"hs", "--hs", Number{0, 30, "m"}, "", "Significant wave height, 4 sqrt(m0)"}, &WaveSettings::hs},
    {{"tp", "--tp", Number{kShortestPeak, kLongestPeak, "s"}, "", "Period of the spectral peak"}, &WaveSettings::tp},
    {{"gamma", "--gamma", Number{1, 20, "1"}, "3.3", "Peak enhancement of JONSWAP"}, &WaveSettings::gamma},
    {{"waves_from", "--waves-from", Number{-360, 360, "degree"}, "",
      "Where the waves come from, clockwise from true north"},
     &WaveSettings::waves_from},
    {{"spread", "--spread", Number{kNarrowestSpread, 81, "degree"}, "spreading mitsuyasu",
      "Circular standard deviation of their directions"},
     &WaveSettings::spread},
    {{"spreading", "--spreading", Word{kSpreadings}, "mitsuyasu",
      "How directions spread: narrower at the peak than above it"},
     &WaveSettings::spreading},
}};
// clang-format on

// What is missing or given twice: "hs is missing; give ...". Empty if WavesOf() can make waves of it. `by_flags`: names
// are those of flags, otherwise of keys.
std::string ProblemOf(const WaveSettings& waves, bool by_flags);
JonswapWaves WavesOf(const WaveSettings& waves);

// What `--swell` says: HS,TP,FROM[,SPREAD]. InvalidArgument without the flag's name.
absl::StatusOr<JonswapWaves> ParseSwell(std::string_view text);

// Makes the waves of --hs and the like the first of `waves`. UsageError where one of their flags is missing.
absl::Status CompleteWaves(SeaSettings& flags);

// UsageError if the settings contradict each other or have no effect.
absl::Status CheckSea(const SeaSettings& sea);

// As a summary states it.
nlohmann::ordered_json Parameters(const SeaSettings& sea);

}  // namespace albtpu::config
