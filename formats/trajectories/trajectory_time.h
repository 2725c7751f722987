// GPS time (weeks, dates, leap seconds), and the relation between the times of trajectories and those of points.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace albtpu::formats {

// GPS time: seconds of a week, weeks, dates, and the leap seconds between it and UTC.

inline constexpr double kSecondsPerWeek = 604800;  // exact

// LAS files whose global encoding has bit 0 state GPS time minus this ("adjusted standard GPS time").
inline constexpr double kAdjustedGpsOffset = 1e9;  // s; ASPRS LAS 1.4 R15, table 4

// Whether `time`, which follows `before`, is in the next week because seconds of the week start again from 0 there: at
// most an hour passes between the two.
bool StartsNextWeek(double before, double time);

// GPS - UTC [s] at an instant given in seconds of UTC since 1980-01-06T00:00:00Z, not counting leap seconds.
int LeapSecondsAtUtc(double utc);

// An instant of ISO 8601 in UTC, `2016-05-11T14:00:00Z`, as GPS time: seconds since 1980-01-06T00:00:00Z, of which it
// is 17 s ahead in 2016. A blank may stand for T; seconds may be omitted or have a fraction. nullopt for other text,
// such as one without Z.
std::optional<double> ParseUtc(std::string_view text);

// The inverse, to whole seconds: `2016-05-11T14:00:00Z`. Requires 0 <= gps_time < 1e11 [s].
std::string UtcText(double gps_time);

// UTC, s since 1970 without leap seconds, of a GPS time, s since 1980, and the inverse.
double UtcOfGps(double gps);
double GpsOfUtc(double utc);

// GPS - UTC [s] at a GPS time, s since 1980.
int GpsMinusUtc(double gps);

// The beginning of a day in UTC as GPS time, s since 1980, by the number of the day in its year, from 1. nullopt where
// there is no such day, or none of a laser survey: before 1990 or after 2100.
std::optional<double> GpsTimeOfDay(int year, int day_of_year);

// A closed interval of seconds.
struct TimeSpan {
  double first = 0, last = 0;
};
// The overlap of two intervals, s; negative: the gap between them.
double Overlap(const TimeSpan& a, const TimeSpan& b);

// A time that no clock gives: 0, which files have where the clock was not known, or not finite.
inline bool IsNoTime(double stated) { return stated == 0 || !std::isfinite(stated); }

// The form of GPS times in a LAS file, global encoding bit 0.
enum class PointTimeForm { kWeekSeconds, kAdjustedStandard };

// All GPS times of the points of a file, as they state them.
struct PointTimes {
  TimeSpan span;
  PointTimeForm form = PointTimeForm::kAdjustedStandard;
  // The beginning of the day, in UTC, on which the file was created by its header: GPS time since 1980.
  std::optional<double> created = std::nullopt;
  std::uint64_t count = 0;  // Of the times; 0: not known.
};

// GPS - UTC since 1 January 2017, for times whose date is not known. IERS has announced no further leap second.
inline constexpr double kGpsMinusUtcNow = 18;  // s

// GPS time since 1980 of a time that a trajectory states; nullopt for seconds of a week, which it does not name.
std::optional<double> GpsTimeOfTrajectory(double stated);

// The time scale of a trajectory: --trajectory-time.
enum class TrajectoryClock { kGps, kUtc };

// `offset` such that time of a point = time of the trajectory + offset. Times of a trajectory are either seconds of a
// week that it does not name, between 0 and a day after the end of the week; or adjusted standard GPS time; or GPS time
// since 1980. A week that is not named is the one in which the trajectory overlaps the points longest. Where neither
// names the week, GPS - UTC is that of the day on which the file of the points was created, or of today, 18 s. Fails
// when there is no overlap with `points`, and names the two ranges and, if it can be found, the cause: times that are
// all 0, another form than the header of the LAS states, another week. Also fails when points of more than a week fit
// several weeks. `name` is the trajectory's.
absl::StatusOr<double> TimeOffset(const std::string& name, const TimeSpan& trajectory, TrajectoryClock clock,
                                  const PointTimes& points);

// The range in words: "302400.0 to 305000.0 s of the GPS week", with week and date where they are known.
std::string DescribePointTimes(const PointTimes& points);

}  // namespace albtpu::formats
