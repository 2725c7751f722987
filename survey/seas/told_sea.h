// What the user says of the sea, by flags or in a survey file: the waves in a file or by their heights and periods, and
// the wind, the depth and the tail that go with them.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "sea/files/sea_file.h"
#include "sea/spectra/described_sea.h"
#include "sea/spectra/jonswap.h"

namespace albtpu::client {

// Absent: not said. Directions are those of the compass, in degrees, from which wind and waves come.
struct ToldSea {
  std::optional<std::string> file, place, time;  // time: one instant of the file; absent: that of each pulse
  std::optional<double> longest_gap;             // h
  std::optional<double> anemometer_height;       // m
  std::vector<JonswapWaves> waves;               // in place of a file
  std::optional<double> wind_speed, wind_from;   // m/s at 10 m; degree
  std::optional<double> water_depth;             // m
  std::optional<std::string> tail;               // kTailRules
  std::optional<double> tail_from;               // Hz

  // Where no waves are told, a wind alone stands for the sea, and a table of winds answers.
  bool has_waves() const { return file.has_value() || !waves.empty(); }

  // For what a record of the file leaves open. Without waves.
  SeaDescription description() const;
  SeaFileOptions file_options() const;
};

// One of the waves.
struct ToldWaves {
  std::optional<double> hs, tp, gamma, waves_from, spread;  // m, s, 1, degree, degree
  std::optional<std::string> spreading;                     // kMitsuyasu
};

// The name of a value in a survey file and on the command line, with its unit and its range.
template <typename Told>
struct ToldNumber {
  std::string_view key, flag, unit;
  double least, greatest;
  std::optional<double> Told::*field;
  std::string_view help;
};
template <typename Told>
struct ToldText {
  std::string_view key, flag;
  std::optional<std::string> Told::*field;
};

// Degree. Waves from a storm that is 500 km wide and 5000 km away come from within 6 degrees, which is a standard
// deviation of 1.7. What is less was meant in radians.
inline constexpr double kNarrowestSpread = 1.6;

inline constexpr std::array<ToldNumber<ToldSea>, 6> kSeaNumbers = {{
    {"wind_speed", "--wind-speed", "m/s", 0, 100, &ToldSea::wind_speed, ""},
    {"wind_from", "--wind-from", "degree", -360, 360, &ToldSea::wind_from, ""},
    {"water_depth", "--sea-depth", "m", 0.1, 20000, &ToldSea::water_depth,
     "Depth of the water that the waves travel in [m] (default: as the file states; otherwise deep)"},
    {"tail_from", "--tail-from", "Hz", 0.05, 10, &ToldSea::tail_from,
     "Where the tail begins [Hz] (default: up to where the waves can be trusted)"},
    {"longest_gap", "--sea-gap", "h", 0, 240, &ToldSea::longest_gap,
     "The longest time between two records of the file that is interpolated [h] (default: 2.5 times the "
     "median "
     "step, from 3 to 15)"},
    {"anemometer_height", "--anemometer-height", "m", 1, 100, &ToldSea::anemometer_height,
     "Height of the winds in an NDBC file of meteorological data [m] (default: 10)"},
}};
inline constexpr std::array<ToldText<ToldSea>, 4> kSeaTexts = {{{"file", "--sea", &ToldSea::file},
                                                                {"time", "--sea-time", &ToldSea::time},
                                                                {"place", "--sea-place", &ToldSea::place},
                                                                {"tail", "--tail", &ToldSea::tail}}};
inline constexpr std::array<ToldNumber<ToldWaves>, 5> kWaveNumbers = {{
    {"hs", "--hs", "m", 0, 30, &ToldWaves::hs, "Significant wave height, 4 sqrt(m0) [m]"},
    {"tp", "--tp", "s", 0.5, 40, &ToldWaves::tp, "Period of the spectral peak [s]"},
    {"gamma", "--gamma", "1", 1, 20, &ToldWaves::gamma, "Peak enhancement of JONSWAP (default: 3.3)"},
    {"waves_from", "--waves-from", "degree", -360, 360, &ToldWaves::waves_from,
     "Where the waves come from [degree, true]"},
    {"spread", "--spread", "degree", kNarrowestSpread, 81, &ToldWaves::spread,
     "Circular standard deviation of their directions [degree] (default: --spreading mitsuyasu)"},
}};
inline constexpr std::array<std::string_view, 4> kTailRules = {"relax", "wind", "level", "none"};
inline constexpr std::string_view kMitsuyasu = "mitsuyasu";

// "a number from 0 to 100 m/s"
std::string RangeText(double least, double greatest, std::string_view unit);

// What is missing or given twice: "hs is missing; give ...". Empty if WavesOf() can make waves of it. `prefix` stands
// before each name: "--" of flags, "" of keys.
std::string ProblemOf(const ToldWaves& told, std::string_view prefix);
JonswapWaves WavesOf(const ToldWaves& told);

// What `--swell` says: HS,TP,FROM[,SPREAD]. InvalidArgument without the flag's name.
absl::StatusOr<JonswapWaves> ParseSwell(std::string_view text);

// UsageError if what is told contradicts itself or has no effect.
absl::Status CheckSea(const ToldSea& sea);

// The flags and what the survey file says, together. A flag overrides the key of the same meaning, and waves that are
// told by flags, in whatever form, those of the file.
ToldSea Together(const ToldSea& flags, const ToldSea& of_file);

// As a summary states it.
nlohmann::ordered_json Parameters(const ToldSea& sea);

}  // namespace albtpu::client
