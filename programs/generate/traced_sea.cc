#include "programs/generate/traced_sea.h"

#include <cmath>
#include <memory>
#include <string_view>
#include <system_error>
#include <vector>

#include "absl/strings/str_cat.h"
#include "sea/angle.h"
#include "sea/files/sea_file.h"
#include "sea/sampled_spectrum.h"
#include "sea/sea_time.h"

namespace albtpu::programs {
namespace {

absl::Status Problem(const SeaOfFile& given, std::string_view what) {
  return absl::InvalidArgumentError(absl::StrCat(given.file.string(), ": ", std::string(what)));
}

// The state of the file at the given time, or its only one.
absl::StatusOr<const SeaRecord*> FindRecord(const SeaOfFile& given, const SeaSeries& series) {
  if (series.points.size() > 1)
    return Problem(given, absl::StrCat("has ", series.points.size(), " places; give a file of one of them"));
  const std::vector<SeaRecord>& records = series.records;
  if (!given.time) {
    if (records.size() == 1) return &records.front();
    return Problem(given, absl::StrCat("has ", records.size(), " states of the sea; choose one by its time, such as ",
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
    if (nearest == nullptr || std::abs(*record.time - *time) < std::abs(*nearest->time - *time)) nearest = &record;
  }
  if (nearest == nullptr) return Problem(given, "does not say when its sea was; leave out the time");
  if (*nearest->time != *time) {
    return Problem(
        given, absl::StrCat("has no sea at ", *given.time, "; the nearest is that of ", SeaTimeText(*nearest->time)));
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

}  // namespace

absl::StatusOr<TracedSea> ReadTracedSea(const SeaOfFile& given) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(given.file, error))
    return absl::NotFoundError(absl::StrCat(given.file.string(), ": no such file of a sea"));
  const absl::StatusOr<SeaSeries> series = ReadSeaFile(given.file);
  if (!series.ok()) return Problem(given, std::string(series.status().message()));
  const absl::StatusOr<const SeaRecord*> record = FindRecord(given, *series);
  if (!record.ok()) return record.status();

  TracedSea sea;
  sea.described = Describe(**record, DescriptionOf(given));
  sea.waves.spectrum = std::make_shared<SampledSpectrum>(
      sea.described.spectrum, SpectrumText{.name = series->format, .reference = "none", .departures = "none"});
  return sea;
}

}  // namespace albtpu::programs
