// The clock by which the times of points are read: that of the header of their file, that which the user names, or
// those that may be meant where neither fits.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/clocks/trajectory_time.h"

namespace albtpu::formats {

// What the user says of the times of the points: --time-format.
enum class TimeFormat { kAuto, kWeek, kAdjusted, kGps, kUnix, kMilliseconds, kDay, kUtcDay };
inline constexpr std::array<std::string_view, 8> kTimeFormatNames = {"auto", "week",         "adjusted", "gps",
                                                                     "unix", "milliseconds", "day",      "utc-day"};

// A way to read the times of points: time = scale * (time as the file states it) + shift, in seconds.
struct PointClock {
  TimeFormat format = TimeFormat::kAuto;  // What accepts it; kAuto for none but the header.
  double scale = 1, shift = 0;
  PointTimeForm form = PointTimeForm::kAdjustedStandard;  // Of the time that results.
  std::string description;                                // For messages: "Unix seconds".

  double operator()(double stated) const { return scale * stated + shift; }
  PointTimes operator()(const TimeSpan& stated) const { return {{(*this)(stated.first), (*this)(stated.last)}, form}; }
  bool changes_times() const { return scale != 1 || shift != 0; }
  bool is_of_day() const { return format == TimeFormat::kDay || format == TimeFormat::kUtcDay; }
};

// The clocks by which `stated` can be read. kAuto: the one that the header states first, in whatever way, then each
// other one by which the points have a date between 1990 and 2060, are seconds of the week or of one of its days. Other
// formats: that one alone, which is several for seconds of a day and for milliseconds. Seconds of a day begin within
// it unless the format names them, and milliseconds are left out where no scanner has so many returns in their time.
// `date`: a GPS time since 1980 near those of the points, where it is known, whose leap seconds are theirs; else those
// at the creation of the file, or of today.
std::vector<PointClock> ClocksOf(const PointTimes& stated, TimeFormat format,
                                 std::optional<double> date = std::nullopt);

// Whether times may be seconds of the week, those of a flight that ends in the next one included.
bool MayBeOfWeek(const TimeSpan& stated);
// Whether times may be seconds of a day, as long as a flight is.
bool MayBeOfDay(const TimeSpan& stated);

// Whether the header states adjusted standard times, and by these a survey before the creation of the file. Those that
// would be seconds of the week are left out: files often state the wrong one of the two.
bool IsHeaderPlausible(const PointTimes& stated);

// "16:53:02", of seconds of a day, or of the week.
std::string HourText(double seconds);
// "16:53:02 to 16:53:22"
std::string HoursText(const TimeSpan& seconds);

// "Wednesday", of seconds of the week or GPS times since 1980.
std::string DayOfWeek(double time);

// "unix"
std::string NameOf(TimeFormat format);

// "--time-format unix"
std::string TimeFormatFlag(const PointClock& clock);

// "Unix seconds or as seconds of the day, a Monday"
std::string ClocksText(std::span<const PointClock> clocks);

// For the user, where a clock was found by what fits: "the GPS times of the points are Unix seconds, not adjusted
// standard GPS times as their file states: only so does `fitting` lie at the points; --time-format unix says so".
std::string ClockNote(const PointClock& clock, const PointTimes& stated, const std::string& fitting);

}  // namespace albtpu::formats
