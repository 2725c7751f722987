// The times of points, and the relation of those of trajectories to them.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "formats/clocks/gps_time.h"

namespace albtpu::formats {

// Whether `time`, which follows `before`, is in the next week because seconds of the week start again from 0 there: at
// most an hour passes between the two.
bool StartsNextWeek(double before, double time);

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
