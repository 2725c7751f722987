#include "config/sea_settings.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_split.h"
#include "formats/text/text.h"
#include "sea/angle.h"
#include "sea/sea_time.h"
#include "sea/spectra/spectrum_moments.h"

namespace albtpu::config {
namespace {

constexpr TailRule kRules[] = {TailRule::kRelax, TailRule::kWind, TailRule::kLevel, TailRule::kNone};

// Without the last bits, which the way through radians changes.
double Degrees(double radians) { return std::round(DegreesOfRadians(radians) * 1e9) / 1e9; }

constexpr std::string_view kOnlyOfFiles[] = {"time", "place", "longest_gap", "anemometer_height"};
constexpr std::string_view kOnlyWithWaves[] = {"water_depth", "tail", "tail_from"};

absl::Status CheckEffect(const SeaSettings& sea, const Key<SeaSettings>& key) {
  if (!IsGiven(key, sea)) return absl::OkStatus();
  const KeyDeclaration& declared = key.declaration;
  const auto no_effect = [&](const char* why) {
    return formats::UsageError(absl::StrCat(std::string(declared.flag), " (", std::string(declared.key),
                                            " in a survey file) has no effect ", why, ", or leave it out"));
  };
  const auto is_one_of = [&](const auto& keys) { return std::ranges::find(keys, declared.key) != std::end(keys); };
  if (!sea.file.has_value() && is_one_of(kOnlyOfFiles)) return no_effect("without a file of the sea; add --sea FILE");
  if (!sea.has_waves() && is_one_of(kOnlyWithWaves))
    return no_effect("without waves; add --sea FILE, or --hs and --tp");
  if (sea.has_waves() && declared.key == "fetch")
    return no_effect("with waves (only tables of winds have a fetch); leave out the waves");
  return absl::OkStatus();
}

// Waves that are higher break: Miche (1944), Ann. Ponts Chaussees 114, with Michell's 0.142 of the length in deep
// water.
absl::Status CheckBreaking(const JonswapWaves& waves, double depth) {
  const double k = WavenumberOfFrequency(1 / waves.peak_period, depth);
  const double highest = 0.142 * 2 * std::numbers::pi / k * std::tanh(k * depth);
  if (!(waves.significant_wave_height > highest)) return absl::OkStatus();
  return formats::UsageError(absl::StrFormat(
      "waves of %g m and %g s are higher than waves can be (they break above %.2g m%s); correct the height "
      "or the period",
      waves.significant_wave_height, waves.peak_period, highest,
      std::isinf(depth) ? "" : absl::StrFormat(" in water of %g m", depth)));
}

// From tail_from on, the spectrum is that of the wind: it would take the place of the waves themselves.
absl::Status CheckTail(const JonswapWaves& waves, double tail_from) {
  if (tail_from > 1 / waves.peak_period) return absl::OkStatus();
  return formats::UsageError(
      absl::StrFormat("--tail-from (tail_from in a survey file): %g Hz is not above the peak of the waves of %g s, "
                      "%.3g Hz, which would be left out; give more, or leave it out",
                      tail_from, waves.peak_period, 1 / waves.peak_period));
}

}  // namespace

SeaDescription SeaSettings::description() const {
  SeaDescription description{.wind_speed_10m = wind_speed, .water_depth = water_depth, .tail_from = tail_from};
  if (wind_from.has_value()) description.wind_from = RadiansOfDegrees(*wind_from);
  for (std::size_t i = 0; i < kTailRules.size(); ++i)
    if (tail == kTailRules[i]) description.tail = kRules[i];
  return description;
}

SeaFileOptions SeaSettings::file_options() const {
  SeaFileOptions options;
  options.anemometer_height = anemometer_height.value_or(options.anemometer_height);
  return options;
}

std::string ProblemOf(const WaveSettings& waves, bool by_flags) {
  for (const Key<WaveSettings>& key : kWaveKeys) {
    const KeyDeclaration& declared = key.declaration;
    if (IsGiven(key, waves) || !declared.absent.empty()) continue;
    return absl::StrCat(std::string(by_flags ? declared.flag : declared.key), " is missing; give ",
                        RangeText(std::get<Number>(declared.values)));
  }
  if (!waves.spread.has_value() || !waves.spreading.has_value()) return "";
  const char* const before = by_flags ? "--" : "";
  return absl::StrCat(before, "spread and ", before, "spreading both say how directions spread; give one of them");
}

JonswapWaves WavesOf(const WaveSettings& settings) {
  JonswapWaves waves{.significant_wave_height = *settings.hs, .peak_period = *settings.tp};
  waves.gamma = settings.gamma.value_or(waves.gamma);
  waves.travels_towards = RadiansOfDegrees(*settings.waves_from) + std::numbers::pi;
  if (settings.spread.has_value()) waves.spread = RadiansOfDegrees(*settings.spread);
  return waves;
}

absl::StatusOr<JonswapWaves> ParseSwell(std::string_view text) {
  const std::vector<std::string> items = absl::StrSplit(absl::string_view(text.data(), text.size()), ',');
  const auto error = [&](const std::string& why) {
    return absl::InvalidArgumentError(absl::StrCat("'", std::string(text), "' ", why,
                                                   "; give HS,TP,FROM or HS,TP,FROM,SPREAD in m, s and degrees, such "
                                                   "as 1.1,9.5,295"));
  };
  if (items.size() < 3 || items.size() > 4) return error("is no swell");
  WaveSettings settings;
  constexpr std::string_view kOrder[] = {"hs", "tp", "waves_from", "spread"};
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto& key = *std::ranges::find(kWaveKeys, kOrder[i], [](const auto& each) { return each.declaration.key; });
    const absl::StatusOr<Value> value = ParseValue(key.declaration, items[i]);
    if (!value.ok())
      return error(absl::StrCat("has the ", std::string(kOrder[i]), " '", items[i], "' (expected ",
                                RangeText(std::get<Number>(key.declaration.values)), ")"));
    Put(*value, key, settings);
  }
  settings.gamma = kSwellGamma;
  JonswapWaves waves = WavesOf(settings);
  if (items.size() == 3) waves.spread = kSwellSpread;
  return waves;
}

absl::Status CompleteWaves(SeaSettings& flags) {
  if (!IsAnyGiven(kWaveKeys, flags.wave_flags)) return absl::OkStatus();
  if (const std::string problem = ProblemOf(flags.wave_flags, true); !problem.empty())
    return formats::UsageError(problem);
  flags.waves.insert(flags.waves.begin(), WavesOf(flags.wave_flags));
  flags.wave_flags = {};
  return absl::OkStatus();
}

absl::Status CheckSea(const SeaSettings& sea) {
  if (sea.file.has_value() && !sea.waves.empty()) {
    return formats::UsageError(
        "--sea (file in a survey file) and --hs, --swell or [[sea.waves]] both say which waves there are; "
        "give one "
        "of them");
  }
  for (const Key<SeaSettings>& key : kSeaKeys)
    if (absl::Status status = CheckEffect(sea, key); !status.ok()) return status;
  for (const JonswapWaves& waves : sea.waves) {
    const double depth = sea.water_depth.value_or(std::numeric_limits<double>::infinity());
    if (absl::Status status = CheckBreaking(waves, depth); !status.ok()) return status;
    if (!sea.tail_from.has_value()) continue;
    if (absl::Status status = CheckTail(waves, *sea.tail_from); !status.ok()) return status;
  }
  if (sea.time.has_value() && !ParseSeaTime(*sea.time).has_value())
    return formats::UsageError(absl::StrCat("--sea-time: '", *sea.time, "' is no time; give UTC as 2020-06-08T03:50Z"));
  return absl::OkStatus();
}

nlohmann::ordered_json Parameters(const SeaSettings& sea) {
  using nlohmann::ordered_json;
  ordered_json json;
  for (const auto& [declared, member] : kSeaKeys) {
    if (declared.key == "fetch") continue;  // Of winds alone.
    ordered_json& value = json[std::string(declared.key)];
    if (const auto* text = std::get_if<std::optional<std::string> SeaSettings::*>(&member)) {
      if ((sea.**text).has_value()) value = *(sea.**text);
    } else if (const auto& number = sea.*std::get<std::optional<double> SeaSettings::*>(member)) {
      value = *number;
    }
  }
  if (sea.file.has_value()) {
    std::error_code unknown;
    const std::filesystem::path path(*sea.file);
    json["file"] = {{"name", path.filename().string()}, {"bytes", std::filesystem::file_size(path, unknown)}};
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

}  // namespace albtpu::config
