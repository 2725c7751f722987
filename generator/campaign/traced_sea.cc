#include "generator/campaign/traced_sea.h"

#include <cmath>
#include <memory>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "sea/angle.h"
#include "sea/files/sea_file.h"
#include "sea/sampled_spectrum.h"
#include "sea/sea_time.h"
#include "sea/spectra/elfouhaily_spectrum.h"
#include "sea/table/sea_attributes.h"
#include "tables/digest.h"

namespace albtpu {
namespace {

absl::Status Problem(const SeaOfFile& told, std::string_view what) {
  return absl::InvalidArgumentError(absl::StrCat(told.file.string(), ": ", std::string(what)));
}

// The state of the file at the time told, or its only one.
absl::StatusOr<const SeaRecord*> FindRecord(const SeaOfFile& told, const SeaSeries& series) {
  if (series.points.size() > 1) {
    return Problem(told, absl::StrCat("has ", series.points.size(), " places; give a file of one of them"));
  }
  const std::vector<SeaRecord>& records = series.records;
  if (!told.time) {
    if (records.size() == 1) return &records.front();
    return Problem(
        told, absl::StrCat("has ", records.size(), " states of the sea; choose one by its time, such as ",
                           records.front().time ? SeaTimeText(*records.front().time) : "its first"));
  }
  const std::optional<double> time = ParseSeaTime(*told.time);
  if (!time) {
    return absl::InvalidArgumentError(
        absl::StrCat("'", *told.time, "' is not a time of a sea; give UTC, such as 2020-06-08T03:50Z"));
  }
  const SeaRecord* nearest = nullptr;
  for (const SeaRecord& record : records) {
    if (!record.time) continue;
    if (nearest == nullptr || std::abs(*record.time - *time) < std::abs(*nearest->time - *time)) {
      nearest = &record;
    }
  }
  if (nearest == nullptr) return Problem(told, "does not say when its sea was; leave out the time");
  if (*nearest->time != *time) {
    return Problem(told, absl::StrCat("has no sea at ", *told.time, "; the nearest is that of ",
                                      SeaTimeText(*nearest->time)));
  }
  return nearest;
}

SeaDescription Told(const SeaOfFile& told) {
  SeaDescription description;
  description.wind_speed_10m = told.wind_speed;
  if (told.wind_from) description.wind_from = RadiansOfDegrees(*told.wind_from);
  description.water_depth = told.water_depth;
  description.tail = told.tail;
  description.tail_from = told.tail_from;
  return description;
}

std::string DigestOf(const HarmonicSpectrum& spectrum) {
  Sha256 sha;
  const auto add = [&](const std::vector<double>& values) {
    sha.Update({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)});
  };
  add(spectrum.k);
  add(spectrum.s);
  for (const std::vector<double>& harmonic : spectrum.a) add(harmonic);
  for (const std::vector<double>& harmonic : spectrum.b) add(harmonic);
  return Hex(sha.Finish());
}

}  // namespace

absl::StatusOr<TracedSea> ReadTracedSea(const SeaOfFile& told) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(told.file, error)) {
    return absl::NotFoundError(absl::StrCat(told.file.string(), ": no such file of a sea"));
  }
  const absl::StatusOr<SeaSeries> series = ReadSeaFile(told.file);
  if (!series.ok()) return Problem(told, std::string(series.status().message()));
  const absl::StatusOr<const SeaRecord*> record = FindRecord(told, *series);
  if (!record.ok()) return record.status();

  TracedSea sea;
  sea.described = Describe(**record, Told(told));
  const bool has_tail = told.tail != TailRule::kNone && sea.described.wind_speed_10m > 0 &&
                        !std::holds_alternative<WholeSea>((*record)->waves);
  sea.attributes = AttributesOf(sea.described, has_tail ? std::optional(told.tail) : std::nullopt);
  sea.attributes["sea_file"] = told.file.filename().string();
  if ((*record)->time) sea.attributes["sea_time"] = SeaTimeText(*(*record)->time);

  std::vector<std::string> departures = Sentences(sea.described.assumed);
  departures.insert(departures.end(), series->assumed.begin(), series->assumed.end());
  const ElfouhailySpectrum any_wind(10, std::numeric_limits<double>::infinity());
  sea.waves.spectrum = std::make_shared<SampledSpectrum>(
      sea.described.spectrum,
      SpectrumText{absl::StrCat("that of ", series->format,
                                has_tail ? ", with the short waves of Elfouhaily et al. (1997)" : ""),
                   has_tail ? any_wind.reference() : "none but the file of the sea",
                   departures.empty() ? "none known" : absl::StrJoin(departures, " ")});
  sea.digest = DigestOf(sea.described.spectrum);
  return sea;
}

}  // namespace albtpu
