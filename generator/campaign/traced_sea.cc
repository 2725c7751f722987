#include "generator/campaign/traced_sea.h"

#include <cmath>
#include <memory>
#include <string_view>
#include <system_error>
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

absl::Status Problem(const SeaOfFile& given, std::string_view what) {
  return absl::InvalidArgumentError(absl::StrCat(given.file.string(), ": ", std::string(what)));
}

// The state of the file at the given time, or its only one.
absl::StatusOr<const SeaRecord*> FindRecord(const SeaOfFile& given, const SeaSeries& series) {
  if (series.points.size() > 1) {
    return Problem(given, absl::StrCat("has ", series.points.size(), " places; give a file of one of them"));
  }
  const std::vector<SeaRecord>& records = series.records;
  if (!given.time) {
    if (records.size() == 1) return &records.front();
    return Problem(
        given, absl::StrCat("has ", records.size(), " states of the sea; choose one by its time, such as ",
                            records.front().time ? SeaTimeText(*records.front().time) : "its first"));
  }
  const std::optional<double> time = ParseSeaTime(*given.time);
  if (!time) {
    return absl::InvalidArgumentError(
        absl::StrCat("'", *given.time, "' is not a time of a sea; give UTC, such as 2020-06-08T03:50Z"));
  }
  const SeaRecord* nearest = nullptr;
  for (const SeaRecord& record : records) {
    if (!record.time) continue;
    if (nearest == nullptr || std::abs(*record.time - *time) < std::abs(*nearest->time - *time)) {
      nearest = &record;
    }
  }
  if (nearest == nullptr) return Problem(given, "does not say when its sea was; leave out the time");
  if (*nearest->time != *time) {
    return Problem(given, absl::StrCat("has no sea at ", *given.time, "; the nearest is that of ",
                                       SeaTimeText(*nearest->time)));
  }
  return nearest;
}

SeaDescription DescriptionOf(const SeaOfFile& given) {
  SeaDescription description;
  description.wind_speed_10m = given.wind_speed;
  if (given.wind_from) description.wind_from = RadiansOfDegrees(*given.wind_from);
  description.water_depth = given.water_depth;
  description.tail = given.tail;
  description.tail_from = given.tail_from;
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

absl::StatusOr<TracedSea> ReadTracedSea(const SeaOfFile& given) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(given.file, error)) {
    return absl::NotFoundError(absl::StrCat(given.file.string(), ": no such file of a sea"));
  }
  const absl::StatusOr<SeaSeries> series = ReadSeaFile(given.file);
  if (!series.ok()) return Problem(given, std::string(series.status().message()));
  const absl::StatusOr<const SeaRecord*> record = FindRecord(given, *series);
  if (!record.ok()) return record.status();

  TracedSea sea;
  sea.described = Describe(**record, DescriptionOf(given));
  const bool has_tail = given.tail != TailRule::kNone && sea.described.wind_speed_10m > 0 &&
                        !std::holds_alternative<WholeSea>((*record)->waves);
  sea.attributes = AttributesOf(sea.described, has_tail ? std::optional(given.tail) : std::nullopt);
  sea.attributes["sea_file"] = given.file.filename().string();
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
