#include "formats/trajectories/point_clock.h"

#include <cmath>
#include <vector>

#include "absl/strings/str_format.h"

namespace albtpu::formats {
namespace {

constexpr double kGpsEpoch = 315964800;  // 1980-01-06T00:00:00Z in s since 1970; exact

// UTC of a GPS time, s since 1970. Within the leap second itself either side of it is right enough.
double UtcOfGps(double gps) {
  const int leap = LeapSecondsAtUtc(gps - LeapSecondsAtUtc(gps));
  return gps - leap + kGpsEpoch;
}

double GpsOfUtc(double utc) { return utc - kGpsEpoch + LeapSecondsAtUtc(utc - kGpsEpoch); }

std::string SpanText(const TimeSpan& utc) {
  return absl::StrFormat("%s to %s", UtcText(GpsOfUtc(utc.first)), UtcText(GpsOfUtc(utc.last)));
}

}  // namespace

absl::StatusOr<double> UtcOffset(const std::string& name, const PointTimes& points, const TimeSpan& known,
                                 const std::string& of) {
  if (!std::isfinite(points.span.first) || !std::isfinite(points.span.last) ||
      (points.span.first == 0 && points.span.last == 0)) {
    return absl::FailedPreconditionError(
        absl::StrFormat("%s: the GPS times of its points are no times, so that no sea of %s belongs to them; choose "
                        "one by --sea-time",
                        name, of));
  }
  const auto outside = [&] {
    return absl::FailedPreconditionError(
        absl::StrFormat("%s: its points were measured outside of %s (they have %s, the file %s); give the "
                        "sea of that time, or choose "
                        "an instant by --sea-time",
                        name, of, DescribePointTimes(points), SpanText(known)));
  };
  if (points.form == PointTimeForm::kAdjustedStandard) {
    const double offset = UtcOfGps(points.span.first + kAdjustedGpsOffset) - points.span.first;
    const bool meets = Overlap({points.span.first + offset, points.span.last + offset}, known) >= 0;
    if (!meets) return outside();
    return offset;
  }
  const double first_week = std::floor(GpsOfUtc(known.first) / kSecondsPerWeek),
               last_week = std::floor(GpsOfUtc(known.last) / kSecondsPerWeek);
  std::vector<double> offsets;
  for (double week = first_week; week <= last_week && offsets.size() < 2; ++week) {
    const double offset = UtcOfGps(week * kSecondsPerWeek + points.span.first) - points.span.first;
    if (Overlap({points.span.first + offset, points.span.last + offset}, known) >= 0) offsets.push_back(offset);
  }
  if (offsets.empty()) return outside();
  if (offsets.size() == 1 && points.span.last - points.span.first < kSecondsPerWeek / 2) return offsets.front();
  return absl::FailedPreconditionError(absl::StrFormat(
      "%s: its GPS times are seconds of a week that they do not name (%s, %s), and %s; choose an instant by "
      "--sea-time, "
      "or give the part of the file that is of the flight",
      name, DescribePointTimes(points), of,
      offsets.size() > 1 ? "the sea has more than one week of them" : "they begin again from 0"));
}

}  // namespace albtpu::formats
