#include "annotate/seas/sea_timeline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "formats/text/text.h"
#include "sea/angle.h"
#include "sea/samples.h"
#include "sea/sea_time.h"
#include "status/status_macros.h"

namespace albtpu::annotate {
namespace {

// s. Buoys report every hour: two reports in a row may be missing.
constexpr double kBridgedGap = 3 * 3600;
// Of a regular series one record may be missing.
constexpr double kBridgedSteps = 2.5;
// s. Models write every 6 hours or more often. Longer gaps are bridged only by --sea-gap.
constexpr double kLongestBridged = kBridgedSteps * 6 * 3600;
constexpr double kSecondsPerHour = 3600;

// The name of a place in messages and for --sea-place.
std::string PlaceName(const SeaPoint& point) {
  if (!point.name.empty()) return point.name;
  if (!point.latitude.has_value() || !point.longitude.has_value()) return "";
  return absl::StrFormat("%.4f,%.4f", *point.latitude, *point.longitude);
}

std::string PlaceNames(const std::vector<SeaPoint>& points) {
  constexpr std::size_t kMaxNamed = 12;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < points.size() && i < kMaxNamed; ++i) names.push_back(PlaceName(points[i]));
  return absl::StrCat(absl::StrJoin(names, "; "),
                      points.size() > kMaxNamed ? absl::StrCat("; and ", points.size() - kMaxNamed, " more") : "");
}

std::optional<std::pair<double, double>> LatitudeAndLongitude(const std::string& text) {
  const std::vector<std::string> parts = absl::StrSplit(text, ',');
  if (parts.size() != 2) return std::nullopt;
  const std::optional<double> latitude = formats::ParseDouble(parts[0]), longitude = formats::ParseDouble(parts[1]);
  if (!latitude.has_value() || !longitude.has_value()) return std::nullopt;
  if (!(std::abs(*latitude) <= 90) || !(std::abs(*longitude) <= 360)) return std::nullopt;
  return std::pair(*latitude, *longitude);
}

// Grows with the distance on the sphere: the haversine of the angle between the two.
double Haversine(double latitude, double longitude, const SeaPoint& point) {
  const double north = RadiansOfDegrees(*point.latitude - latitude),
               east = RadiansOfDegrees(*point.longitude - longitude);
  return std::pow(std::sin(north / 2), 2) + std::cos(RadiansOfDegrees(latitude)) *
                                                std::cos(RadiansOfDegrees(*point.latitude)) *
                                                std::pow(std::sin(east / 2), 2);
}

std::optional<std::size_t> Nearest(double latitude, double longitude, const std::vector<SeaPoint>& points) {
  std::optional<std::size_t> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].latitude.has_value() || !points[i].longitude.has_value()) continue;
    const double apart = Haversine(latitude, longitude, points[i]);
    if (apart < least) {
      least = apart;
      nearest = i;
    }
  }
  return nearest;
}

absl::StatusOr<std::size_t> ChoosePlace(const std::optional<std::string>& wanted, const std::vector<SeaPoint>& points) {
  if (!wanted.has_value()) {
    if (points.size() == 1) return 0;
    return absl::InvalidArgumentError(absl::StrCat("has ", points.size(), " places (", PlaceNames(points),
                                                   "); name one by --sea-place, or give LAT,LON for the nearest"));
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    if (PlaceName(points[i]) == *wanted) return i;
  const auto at = LatitudeAndLongitude(*wanted);
  const std::optional<std::size_t> nearest = at.has_value() ? Nearest(at->first, at->second, points) : std::nullopt;
  if (nearest.has_value()) return *nearest;
  return absl::InvalidArgumentError(
      absl::StrCat("has no place '", *wanted, "' (it has ", PlaceNames(points), "); name one of them by --sea-place"));
}

double LongestGap(const config::SeaSettings& settings, const std::vector<double>& times) {
  if (settings.longest_gap.has_value()) return *settings.longest_gap * kSecondsPerHour;
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  if (steps.empty()) return kBridgedGap;
  return std::clamp(kBridgedSteps * Median(std::move(steps)), kBridgedGap, kLongestBridged);
}

}  // namespace

absl::StatusOr<SeaTimeline> SeaTimeline::Open(const config::SeaSettings& settings) {
  SeaTimeline seas;
  seas.settings_ = settings;
  if (!settings.file.has_value()) {
    seas.records_.push_back({.waves = std::make_shared<const std::vector<JonswapWaves>>(settings.waves)});
    seas.fixed_ = BetweenRecords{};
    return seas;
  }
  absl::StatusOr<SeaSeries> series = ReadSeaFile(*settings.file, settings.file_options());
  absl::Status status = series.status();
  if (status.ok()) {
    std::vector<SeaRecord> records = std::exchange(series->records, {});
    seas.series_ = *std::move(series);
    status = seas.TakePlace(std::move(records));
  }
  if (status.ok()) status = seas.TakeTime();
  if (!status.ok())
    return absl::Status(status.code(), absl::StrCat(*settings.file, ": ", std::string(status.message())));
  return seas;
}

absl::Status SeaTimeline::TakePlace(std::vector<SeaRecord> records) {
  ASSIGN_OR_RETURN(const std::size_t place, ChoosePlace(settings_.place, series_.points));
  place_ = PlaceName(series_.points[place]);
  for (SeaRecord& record : records)
    if (record.point == place) records_.push_back(std::move(record));
  if (records_.empty())
    return absl::InvalidArgumentError(
        absl::StrCat("has no record of the place '", place_, "'; name another one by --sea-place"));
  const bool complete = std::holds_alternative<WholeSea>(records_.front().waves);
  if (complete && (settings_.tail.has_value() || settings_.tail_from.has_value()))
    return absl::InvalidArgumentError(
        "is a sea by wavenumber, which is complete (no tail is joined); leave out tail and tail_from");
  return absl::OkStatus();
}

absl::Status SeaTimeline::TakeTime() {
  const bool timed = records_.front().time.has_value();
  if (timed) {
    for (const SeaRecord& record : records_) times_.push_back(*record.time);
    longest_gap_ = LongestGap(settings_, times_);
  }
  if (!settings_.time.has_value()) {
    if (records_.size() == 1) fixed_ = BetweenRecords{};
    return absl::OkStatus();
  }
  if (!timed) return absl::InvalidArgumentError("its sea has no time, so that --sea-time has no effect; leave it out");
  fixed_ = At(*ParseSeaTime(*settings_.time));
  if (fixed_.has_value()) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrFormat("has no sea at %s (its %d records last %s, and gaps of up to %g h are bridged); choose "
                      "another --sea-time, or a longer --sea-gap (longest_gap in a survey file)",
                      *settings_.time, records_.size(), SpanText(*this), longest_gap_ / kSecondsPerHour));
}

std::optional<BetweenRecords> SeaTimeline::At(double time, std::size_t guess) const {
  if (!(time >= start() && time <= end())) return std::nullopt;
  std::size_t first = guess;
  if (!(guess + 1 < times_.size() && times_[guess] <= time && time < times_[guess + 1]))
    first = static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), time) - times_.begin()) - 1;
  if (time == times_[first]) return BetweenRecords{first, first, 0};
  const std::size_t second = first + 1;
  const double step = times_[second] - times_[first];
  if (step > longest_gap_) return std::nullopt;
  return BetweenRecords{first, second, (time - times_[first]) / step};
}

std::pair<std::size_t, std::size_t> SeaTimeline::RecordsWithin(double first, double last) const {
  std::size_t begin = 0, end = times_.size() - 1;
  while (begin < end && times_[begin + 1] <= first) ++begin;
  while (end > begin && times_[end - 1] >= last) --end;
  return {begin, end};
}

absl::Status NotOfOnlyRecord(const std::string& name, const std::string& times, const SeaTimeline& seas) {
  const std::string time = SeaTimeText(*seas.unchosen_time());
  return absl::FailedPreconditionError(absl::StrFormat(
      "%s: its points were not all measured within %g h of %s, the time of the only record of %s (they have %s); give "
      "the sea of their time, or take this one all the same by --sea-time %s",
      name, seas.longest_gap() / kSecondsPerHour, time, *seas.settings().file, times, time));
}

std::string SpanText(const SeaTimeline& seas) {
  return absl::StrCat("from ", SeaTimeText(seas.start()), " to ", SeaTimeText(seas.end()));
}

}  // namespace albtpu::annotate
