#include "formats/clocks/trajectory_time.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace albtpu::formats {

bool StartsNextWeek(double before, double time) {
  constexpr double kLongestPause = 3600;  // s
  const double step = time + kSecondsPerWeek - before;
  return time < before && before <= kSecondsPerWeek && time >= 0 && step > 0 && step <= kLongestPause;
}

namespace {

// GPS - UTC [s] of seconds of a week that neither the points nor their trajectory name.
double GpsMinusUtcOfAnyWeek(const PointTimes& points) {
  return points.created.has_value() ? GpsMinusUtc(*points.created) : kGpsMinusUtcNow;
}

// A trajectory that began before the end of the week goes on for less than a day: no flight is longer.
constexpr double kLongestContinuation = kSecondsPerDay;
constexpr double kLastWeekTime = kSecondsPerWeek + kLongestContinuation;

bool AreWeekSeconds(const TimeSpan& span) { return span.first >= 0 && span.first < kLastWeekTime; }

// Of the candidates, the one with which the trajectory overlaps the points longest; the first of equal ones.
struct Candidate {
  double offset = 0;
  double overlap = 0;  // s, as Overlap.
};
template <typename Offsets>
Candidate Longest(const TimeSpan& trajectory, const TimeSpan& points, const Offsets& offsets) {
  Candidate best = {0, -INFINITY};
  for (const double offset : offsets) {
    const double overlap = Overlap({trajectory.first + offset, trajectory.last + offset}, points);
    if (overlap > best.overlap) best = {offset, overlap};
  }
  return best;
}

Candidate BestOffset(const TimeSpan& trajectory, TrajectoryClock clock, const PointTimes& points) {
  const bool week_seconds = AreWeekSeconds(trajectory);
  const double later = clock == TrajectoryClock::kUtc ? 1 : 0;
  if (points.form == PointTimeForm::kWeekSeconds) {
    // The week of the points is not known; that of a trajectory with absolute times is.
    const auto of_base = [&](double base) {
      // Points that start again from 0 span the whole week. Their trajectory is in the week in which it began.
      const Candidate same_week = Longest(trajectory, points.span, std::array{base});
      if (same_week.overlap >= 0) return same_week;
      return Longest(trajectory, points.span, std::array{base, base - kSecondsPerWeek, base + kSecondsPerWeek});
    };
    if (week_seconds) return of_base(later * GpsMinusUtcOfAnyWeek(points));
    const auto of_gps = [&](double gps) {
      const double week = gps - trajectory.first - kSecondsPerWeek * std::floor(gps / kSecondsPerWeek);
      return of_base(week + later * GpsMinusUtc(gps));
    };
    const Candidate best = of_gps(*GpsTimeOfTrajectory(trajectory.first));
    // From 2000 to September 2011, GPS times since 1980 are as large as adjusted ones after 2031.
    constexpr double kFirstSurveys = 6.3e8;
    if (best.overlap >= 0 || trajectory.first < kFirstSurveys || trajectory.first >= kAdjustedGpsOffset) return best;
    const Candidate since_1980 = of_gps(trajectory.first);
    return since_1980.overlap >= 0 ? since_1980 : best;
  }
  const double gps = points.span.first + kAdjustedGpsOffset;
  const double leap = later * GpsMinusUtc(gps);
  if (!week_seconds) return Longest(trajectory, points.span, std::array{leap, leap - kAdjustedGpsOffset});
  // The week of the first point, of the last point, and the one before: the trajectory may have begun in it.
  const double first_week = kSecondsPerWeek * std::floor(gps / kSecondsPerWeek) - kAdjustedGpsOffset + leap;
  const double last_week = kSecondsPerWeek * std::floor((points.span.last + kAdjustedGpsOffset) / kSecondsPerWeek) -
                           kAdjustedGpsOffset + leap;
  return Longest(trajectory, points.span, std::array{first_week, first_week - kSecondsPerWeek, last_week});
}

// A trajectory that does not name its week has records in more than one week of the points.
bool IsAmbiguous(const TimeSpan& trajectory, const PointTimes& points) {
  if (points.form != PointTimeForm::kAdjustedStandard || !AreWeekSeconds(trajectory)) return false;
  // Records and points may match in two weeks if their total duration reaches a week.
  const double lasts = trajectory.last - trajectory.first + points.span.last - points.span.first;
  if (lasts < kSecondsPerWeek) return false;
  const double gps = points.span.first + kAdjustedGpsOffset;
  int weeks = 0;
  const double first_week = std::floor(gps / kSecondsPerWeek) - 1;
  const double last_week = std::floor((points.span.last + kAdjustedGpsOffset) / kSecondsPerWeek);
  // Counted in whole numbers: the next week of a time that no clock gives is the same one.
  for (int i = 0; i <= 3 && first_week + i <= last_week; ++i) {
    const double offset = (first_week + i) * kSecondsPerWeek - kAdjustedGpsOffset;
    if (Overlap({trajectory.first + offset, trajectory.last + offset}, points.span) >= 0) ++weeks;
  }
  return weeks > 1;
}

// The clock that trajectories do not have, but by which this one has records at the times of the points.
std::optional<std::string> ClockOfTrajectory(const TimeSpan& trajectory, TrajectoryClock clock,
                                             const PointTimes& points) {
  const auto fits = [&](double scale, double shift) {
    const TimeSpan read = {trajectory.first * scale + shift, trajectory.last * scale + shift};
    return read.first >= 0 && BestOffset(read, clock, points).overlap >= 0;
  };
  for (const double scale : {1.0, 1e-3}) {
    const std::string unit = scale == 1 ? "seconds" : "milliseconds";
    if (scale != 1 && fits(scale, 0)) return unit;
    if (fits(scale, kGpsMinusUtcNow - kGpsEpoch)) return absl::StrCat("Unix ", unit);
    if (trajectory.first < 0 || trajectory.last * scale > 2 * kSecondsPerDay) continue;
    for (int day = 1; day < 7; ++day)
      if (fits(scale, day * kSecondsPerDay)) return absl::StrCat(unit, " of the day");
  }
  return std::nullopt;
}

// The reason why two ranges do not overlap, and what to do about it.
struct Mismatch {
  std::string why, suggestion;
};
Mismatch MismatchCause(const TimeSpan& trajectory, TrajectoryClock clock, const PointTimes& points) {
  const TimeSpan& span = points.span;
  if (span.first == 0 && span.last == 0)
    return {"the GPS times of the points are all 0", "export the LAS again with GPS times"};
  if (points.form == PointTimeForm::kWeekSeconds && (span.first < 0 || span.last > kLastWeekTime)) {
    const PointTimes adjusted = {span, PointTimeForm::kAdjustedStandard};
    if (span.last - span.first < kSecondsPerWeek && BestOffset(trajectory, clock, adjusted).overlap >= 0) {
      return {"the header of the LAS states seconds of the GPS week, but these are adjusted standard GPS times",
              "set bit 0 of its global encoding, or give --time-format adjusted"};
    }
    return {
        "the header of the LAS states seconds of the GPS week, but these are of another clock, and of none by which "
        "the trajectory is there",
        "give the trajectory of this flight, or name the clock by --time-format"};
  }
  const PointTimes other_form = {span, PointTimeForm::kWeekSeconds};
  if (points.form == PointTimeForm::kAdjustedStandard && span.first >= 0 && span.last <= kLastWeekTime &&
      BestOffset(trajectory, clock, other_form).overlap >= 0) {
    return {"the header of the LAS states adjusted standard GPS times, but these are seconds of the GPS week",
            "clear bit 0 of its global encoding, or give --time-format week"};
  }
  // A trajectory that is not much longer than the recording may miss it by the seconds between the two clocks.
  const bool utc = clock == TrajectoryClock::kUtc;
  const TrajectoryClock other_clock = utc ? TrajectoryClock::kGps : TrajectoryClock::kUtc;
  if (BestOffset(trajectory, other_clock, points).overlap >= 0) {
    return {absl::StrCat("its times fit as ", utc ? "GPS time" : "UTC"),
            absl::StrCat("give --trajectory-time ", utc ? "gps" : "utc")};
  }
  // Apart by whole weeks: the trajectory of the same hours of another week.
  const double offset = BestOffset(trajectory, clock, points).offset;
  const double apart = (span.first + span.last - trajectory.first - trajectory.last) / 2 - offset;
  const double weeks = std::round(apart / kSecondsPerWeek);
  const double shift = offset + weeks * kSecondsPerWeek;
  if (weeks != 0 && Overlap({trajectory.first + shift, trajectory.last + shift}, span) >= 0) {
    return {absl::StrFormat("another week: it is %.0f week%s %s", std::abs(weeks), std::abs(weeks) == 1 ? "" : "s",
                            weeks > 0 ? "earlier" : "later"),
            "give the trajectory of this flight"};
  }
  // Seconds of a week, counted from the beginning of an earlier one.
  const double counted = std::floor(trajectory.first / kSecondsPerWeek);
  const TimeSpan reduced = {trajectory.first - counted * kSecondsPerWeek, trajectory.last - counted * kSecondsPerWeek};
  if (counted > 0 && BestOffset(reduced, clock, points).overlap >= 0) {
    return {absl::StrFormat("another week: it is %.0f week%s later", counted, counted == 1 ? "" : "s"),
            "give the trajectory of this flight"};
  }
  if (const std::optional<std::string> units = ClockOfTrajectory(trajectory, clock, points); units.has_value()) {
    return {absl::StrCat("another flight, or its times are ", *units),
            "give the trajectory of this one, with seconds of the GPS week or GPS times"};
  }
  return {"another flight", "give the trajectory of this one"};
}

}  // namespace

std::optional<double> GpsTimeOfTrajectory(double stated) {
  if (AreWeekSeconds({stated, stated})) return std::nullopt;
  return stated < kAdjustedGpsOffset ? stated + kAdjustedGpsOffset : stated;
}

double Overlap(const TimeSpan& a, const TimeSpan& b) { return std::min(a.last, b.last) - std::max(a.first, b.first); }

std::string DescribePointTimes(const PointTimes& points) {
  constexpr double kOfNoClock = 1e17;  // Unix time in microseconds has 2e15.
  if (std::max(std::abs(points.span.first), std::abs(points.span.last)) >= kOfNoClock)
    return absl::StrFormat("%.3g to %.3g s, which no clock gives", points.span.first, points.span.last);
  if (points.form == PointTimeForm::kWeekSeconds)
    return absl::StrFormat("%.1f to %.1f s of the GPS week", points.span.first, points.span.last);
  const double gps = points.span.first + kAdjustedGpsOffset;
  const double week = std::floor(gps / kSecondsPerWeek);
  const double begin = week * kSecondsPerWeek;
  return absl::StrFormat("%.1f to %.1f s of GPS week %.0f%s", gps - begin,
                         points.span.last + kAdjustedGpsOffset - begin, week,
                         gps >= 0 && gps < kLastText ? absl::StrFormat(" (%s)", DateText(gps)) : "");
}

absl::StatusOr<double> TimeOffset(const std::string& name, const TimeSpan& trajectory, TrajectoryClock clock,
                                  const PointTimes& points) {
  if (IsAmbiguous(trajectory, points)) {
    return absl::InvalidArgumentError(
        absl::StrFormat("%s: fits more than one week of the points, which last %.1f days (it does not name its week); "
                        "split the LAS by flight, or give a trajectory with GPS times since 1980",
                        name, (points.span.last - points.span.first) / 86400));
  }
  const Candidate best = BestOffset(trajectory, clock, points);
  if (best.overlap >= 0 && !(points.span.first == 0 && points.span.last == 0)) return best.offset;
  const Mismatch mismatch = MismatchCause(trajectory, clock, points);
  return absl::InvalidArgumentError(absl::StrFormat(
      "%s: no record at the times of the points: it has %.1f to %.1f s, they have %s (%s); %s", name, trajectory.first,
      trajectory.last, DescribePointTimes(points), mismatch.why, mismatch.suggestion));
}

}  // namespace albtpu::formats
