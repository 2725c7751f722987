#include "survey/seas/told_sea.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_split.h"
#include "sea/angle.h"
#include "sea/sea_time.h"
#include "sea/spectra/dispersion.h"
#include "survey/exit_status.h"
#include "survey/number_text.h"

namespace albtpu::client {
namespace {

constexpr TailRule kRules[] = {TailRule::kRelax, TailRule::kWind, TailRule::kLevel, TailRule::kNone};

template <typename Each>
std::string BothNames(const Each& each) {
  return absl::StrCat(std::string(each.flag), " (", std::string(each.key), " in a survey file)");
}

template <typename Each>
bool IsTold(const ToldSea& sea, const Each& each) {
  return (sea.*each.field).has_value();
}

// Without the last bits, which the way through radians changes.
double Degrees(double radians) { return std::round(DegreesOfRadians(radians) * 1e9) / 1e9; }

constexpr std::string_view kOnlyOfFiles[] = {"time", "place", "longest_gap", "anemometer_height"};
constexpr std::string_view kOnlyWithWaves[] = {"water_depth", "tail", "tail_from"};

template <typename Each>
absl::Status CheckEffect(const ToldSea& sea, const Each& each) {
  if (!IsTold(sea, each)) return absl::OkStatus();
  const auto is_one_of = [&](const auto& keys) {
    for (const std::string_view key : keys)
      if (key == each.key) return true;
    return false;
  };
  if (!sea.file.has_value() && is_one_of(kOnlyOfFiles)) {
    return UsageError(absl::StrCat(BothNames(each), " has no effect without a file of the sea; add ",
                                   "--sea FILE, or leave it out"));
  }
  if (!sea.has_waves() && is_one_of(kOnlyWithWaves)) {
    return UsageError(absl::StrCat(BothNames(each),
                                   " has no effect without waves; add --sea FILE, or --hs and ",
                                   "--tp, or leave it out"));
  }
  return absl::OkStatus();
}

// Waves that are higher break: Miche (1944), Ann. Ponts Chaussees 114, with Michell's 0.142 of the length in deep
// water.
absl::Status CheckBreaking(const JonswapWaves& waves, double depth) {
  const double k = WavenumberOfFrequency(1 / waves.peak_period, depth);
  const double highest = 0.142 * 2 * std::numbers::pi / k * std::tanh(k * depth);
  if (!(waves.significant_wave_height > highest)) return absl::OkStatus();
  return UsageError(absl::StrFormat(
      "waves of %g m and %g s are higher than waves can be (they break above %.2g m%s); correct the height "
      "or the period",
      waves.significant_wave_height, waves.peak_period, highest,
      std::isinf(depth) ? "" : absl::StrFormat(" in water of %g m", depth)));
}

}  // namespace

SeaDescription ToldSea::description() const {
  SeaDescription description{
      .wind_speed_10m = wind_speed, .water_depth = water_depth, .tail_from = tail_from};
  if (wind_from.has_value()) description.wind_from = RadiansOfDegrees(*wind_from);
  for (std::size_t i = 0; i < kTailRules.size(); ++i)
    if (tail == kTailRules[i]) description.tail = kRules[i];
  return description;
}

SeaFileOptions ToldSea::file_options() const {
  SeaFileOptions options;
  options.anemometer_height = anemometer_height.value_or(options.anemometer_height);
  return options;
}

std::string RangeText(double least, double greatest, std::string_view unit) {
  return absl::StrCat("a number from ", least, " to ", greatest, unit == "1" ? "" : " ",
                      unit == "1" ? "" : std::string(unit));
}

std::string ProblemOf(const ToldWaves& told, std::string_view prefix) {
  const std::string before(prefix);
  for (const auto& each : kWaveNumbers) {
    if ((told.*each.field).has_value() || each.key == "gamma" || each.key == "spread") continue;
    const std::string name(before.empty() ? each.key : each.flag);
    return absl::StrCat(name, " is missing; give ", RangeText(each.least, each.greatest, each.unit));
  }
  if (told.spread.has_value() && told.spreading.has_value())
    return absl::StrCat(before, "spread and ", before,
                        "spreading both say how directions spread; give one of them");
  return "";
}

JonswapWaves WavesOf(const ToldWaves& told) {
  JonswapWaves waves{.significant_wave_height = *told.hs, .peak_period = *told.tp};
  waves.gamma = told.gamma.value_or(waves.gamma);
  waves.travels_towards = RadiansOfDegrees(*told.waves_from) + std::numbers::pi;
  if (told.spread.has_value()) waves.spread = RadiansOfDegrees(*told.spread);
  return waves;
}

absl::StatusOr<JonswapWaves> ParseSwell(std::string_view text) {
  const std::vector<std::string> items = absl::StrSplit(absl::string_view(text.data(), text.size()), ',');
  const auto error = [&](const std::string& why) {
    return absl::InvalidArgumentError(
        absl::StrCat("'", std::string(text), "' ", why,
                     "; give HS,TP,FROM or HS,TP,FROM,SPREAD in m, s and degrees, such "
                     "as 1.1,9.5,295"));
  };
  if (items.size() < 3 || items.size() > 4) return error("is no swell");
  ToldWaves told;
  told.gamma = kSwellGamma;
  constexpr std::string_view kOrder[] = {"hs", "tp", "waves_from", "spread"};
  for (std::size_t i = 0; i < items.size(); ++i) {
    for (const auto& each : kWaveNumbers) {
      if (each.key != kOrder[i]) continue;
      told.*each.field = ParseDouble(items[i]);
      const double value = (told.*each.field).value_or(NAN);
      if (!(value >= each.least && value <= each.greatest)) {
        return error(absl::StrCat("has the ", std::string(each.key), " '", items[i], "' (expected ",
                                  RangeText(each.least, each.greatest, each.unit), ")"));
      }
    }
  }
  JonswapWaves waves = WavesOf(told);
  if (items.size() == 3) waves.spread = kSwellSpread;
  return waves;
}

absl::Status CheckSea(const ToldSea& sea) {
  if (sea.file.has_value() && !sea.waves.empty()) {
    return UsageError(
        "--sea (file in a survey file) and --hs, --swell or [[sea.waves]] both say which waves there are; "
        "give one "
        "of them");
  }
  for (const auto& each : kSeaNumbers)
    if (absl::Status status = CheckEffect(sea, each); !status.ok()) return status;
  for (const auto& each : kSeaTexts)
    if (absl::Status status = CheckEffect(sea, each); !status.ok()) return status;
  for (const JonswapWaves& waves : sea.waves) {
    const double depth = sea.water_depth.value_or(std::numeric_limits<double>::infinity());
    if (absl::Status status = CheckBreaking(waves, depth); !status.ok()) return status;
  }
  if (sea.time.has_value() && !ParseSeaTime(*sea.time).has_value()) {
    return UsageError(
        absl::StrCat("--sea-time: '", *sea.time, "' is no time; give UTC as 2020-06-08T03:50Z"));
  }
  return absl::OkStatus();
}

ToldSea Together(const ToldSea& flags, const ToldSea& of_file) {
  ToldSea sea = of_file;
  if (flags.has_waves()) {  // Then what goes with the waves of the survey file goes with them.
    sea.waves.clear();
    sea.file = sea.place = sea.time = {};
    sea.longest_gap = sea.anemometer_height = {};
  }
  for (const auto& each : kSeaNumbers)
    if (IsTold(flags, each)) sea.*each.field = flags.*each.field;
  for (const auto& each : kSeaTexts)
    if (IsTold(flags, each)) sea.*each.field = flags.*each.field;
  if (!flags.waves.empty()) sea.waves = flags.waves;
  return sea;
}

nlohmann::ordered_json Parameters(const ToldSea& sea) {
  using nlohmann::ordered_json;
  ordered_json json;
  for (const auto& each : kSeaTexts) {
    const std::optional<std::string>& text = sea.*each.field;
    json[std::string(each.key)] = text.has_value() ? ordered_json(*text) : ordered_json();
  }
  if (sea.file.has_value()) {
    std::error_code unknown;
    const std::filesystem::path path(*sea.file);
    json["file"] = {{"name", path.filename().string()}, {"bytes", std::filesystem::file_size(path, unknown)}};
  }
  for (const auto& each : kSeaNumbers) {
    const std::optional<double>& number = sea.*each.field;
    json[std::string(each.key)] = number.has_value() ? ordered_json(*number) : ordered_json();
  }
  json["waves"] = ordered_json::array();
  for (const JonswapWaves& waves : sea.waves) {
    json["waves"].push_back(
        {{"hs", waves.significant_wave_height},
         {"tp", waves.peak_period},
         {"gamma", waves.gamma},
         {"waves_from", Degrees(waves.travels_towards - std::numbers::pi)},
         {"spread", waves.spread.has_value() ? ordered_json(Degrees(*waves.spread)) : ordered_json()}});
  }
  return json;
}

}  // namespace albtpu::client
