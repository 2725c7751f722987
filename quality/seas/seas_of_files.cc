#include "quality/seas/seas_of_files.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "annotate/seas/sea_facts.h"
#include "sea/angle.h"
#include "sea/files/sea_series.h"
#include "sea/sea_state.h"
#include "sea/sea_time.h"
#include "sea/water_index.h"
#include "status/status_macros.h"

namespace albtpu::quality {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kSameSea = 1e-6;  // m, s, m/s or degree: of numbers that other machines computed.

std::optional<double> NumberOf(const Json& in, const char* key) {
  const Json number = in.is_object() ? in.value(key, Json()) : Json();
  return number.is_number() ? std::optional(number.get<double>()) : std::nullopt;
}

// In the middle of the records of the sea that the summary names, s since 1970.
std::optional<double> TimeOf(const Json& sea) {
  std::optional<double> middle;
  for (const char* const key : {"first", "last"}) {
    const Json record = sea.value(key, Json());
    const Json text = record.is_object() ? record.value("time", Json()) : Json();
    const std::optional<double> time = text.is_string() ? ParseSeaTime(text.get<std::string>()) : std::nullopt;
    if (!time.has_value()) return std::nullopt;
    middle = middle.has_value() ? (*middle + *time) / 2 : *time;
  }
  return middle;
}

// The spectrum of the waves in the table of winds; empty in summaries of versions before 1.0, which do not state it.
std::string SpectrumOf(const AnnotatedLasFile& file) {
  const Json table = file.summary().value("table", Json());
  const Json spectrum = table.is_object() ? table.value("spectrum", Json()) : Json();
  return spectrum.is_string() ? spectrum.get<std::string>() : "";
}

absl::Status NeedsTheSea(const AnnotatedLasFile& file, const std::string& why) {
  return absl::InvalidArgumentError(absl::StrCat(
      file.path().string(), ": ", why,
      "; give the sea that it was annotated with by --survey, or by the same flags as albtpu-query las was given"));
}

// Whether the sea is the one that a summary states, by its first record: of other waves, points share another part.
absl::Status CheckStated(const AnnotatedLasFile& file, const annotate::SeaTimeline& seas, const Json& summary) {
  const Json stated = MemberOf(summary, "first");
  if (!stated.is_object()) return absl::OkStatus();
  std::size_t record = 0;
  if (!seas.by_time()) {
    record = seas.fixed().first;
  } else if (const Json text = MemberOf(stated, "time"); text.is_string()) {
    const std::optional<double> time = ParseSeaTime(text.get<std::string>());
    const std::optional<annotate::BetweenRecords> between = time.has_value() ? seas.At(*time) : std::nullopt;
    if (between.has_value()) record = between->weight < 0.5 ? between->first : between->second;
  }
  constexpr double kNoPeriod = std::numeric_limits<double>::infinity();
  constexpr std::pair<const char*, double> kFacts[] = {
      {"hs", kNoPeriod},  {"tp", kNoPeriod},   {"axis", 180},           {"wind_speed", kNoPeriod},
      {"x_azimuth", 360}, {"tail", kNoPeriod}, {"tail_from", kNoPeriod}};
  const Json given = annotate::Json(annotate::FactsOf(seas, record));
  for (const auto& [key, period] : kFacts) {
    const Json then = MemberOf(stated, key), now = MemberOf(given, key);
    const bool same = then.is_number() && now.is_number()
                          ? std::abs(std::remainder(then.get<double>() - now.get<double>(), period)) <= kSameSea
                          : then == now || !stated.contains(key);
    if (!same)
      return NeedsTheSea(file, absl::StrCat("was annotated for another sea: its ", key, " is ", then.dump(),
                                            ", and that of the given one is ", now.dump()));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<SeaOfSource> SeaOfFile(const AnnotatedLasFile& file, const annotate::SeaTimeline* seas) {
  const Json& parameters = file.summary()["parameters"];
  const Json of_input = file.summary()["input"].value("sea", Json());
  const Json stated = of_input.is_object() ? of_input : parameters.value("sea", Json());
  const double index = NumberOf(parameters, "water_index").value_or(kSeaWaterIndex);
  if (seas != nullptr) {
    if (!stated.is_object()) return NeedsTheSea(file, "was annotated for a wind, not for the waves that are given");
    std::size_t record = 0;
    if (seas->by_time()) {
      const std::optional<double> time = TimeOf(stated);
      const std::optional<annotate::BetweenRecords> between = time.has_value() ? seas->At(*time) : std::nullopt;
      if (!between.has_value()) return NeedsTheSea(file, "was not annotated with a time of the sea that is given");
      record = between->weight < 0.5 ? between->first : between->second;
    } else {
      record = seas->fixed().weight < 0.5 ? seas->fixed().first : seas->fixed().second;
    }
    RETURN_IF_ERROR(CheckStated(file, *seas, stated));
    DescribedSea sea = Describe(seas->record(record), seas->settings().description());
    return SeaOfSource{.spectrum = std::move(sea.spectrum), .x_azimuth = sea.x_azimuth, .water_index = index};
  }
  if (stated.is_object()) return NeedsTheSea(file, "was annotated for waves, which its summary does not have");
  const std::optional<double> wind = NumberOf(parameters, "wind_speed");
  if (!wind.has_value()) return NeedsTheSea(file, "does not state the wind");
  const double from = NumberOf(parameters, "wind_from").value_or(0);
  SeaOfSource sea{.spectrum = {}, .x_azimuth = RadiansOfDegrees(from) + std::numbers::pi, .water_index = index};
  if (*wind > 0) {
    const WindSea waves{.wind_speed_10m = *wind,
                        .fetch = NumberOf(parameters, "fetch").value_or(kFullyDeveloped),
                        .model = &SpectrumModelNamed(SpectrumOf(file))};
    sea.spectrum = Sampled(*waves.MakeSpectrum(), SeaWavenumbers(), kSeaHarmonics);
  } else {
    sea.spectrum = FlatSea(SeaWavenumbers(), 1);
  }
  return sea;
}

}  // namespace albtpu::quality
