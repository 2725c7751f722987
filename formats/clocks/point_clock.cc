#include "formats/clocks/point_clock.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"

namespace albtpu::formats {
namespace {

constexpr double kMillisecond = 1e-3;  // s, exact.
// GPS times of 1990 and 2060. Airborne lasers have been placed by GPS since about 1990.
constexpr double kEarliest = 315e6, kLatest = 2525e6;
// A flight that began before the end of a week or a day goes on for less than a day.
constexpr double kLastOfWeek = kSecondsPerWeek + kSecondsPerDay, kLastOfDay = 2 * kSecondsPerDay;
// 1/s; scanners send up to 5 million pulses, and those that see the bottom have less than 1 million with five returns.
constexpr double kMostReturns = 5e6;
constexpr double kShortest = 1e-3;  // s; points of one pulse have equal times.

constexpr std::array<std::string_view, 7> kDays = {"Sunday",   "Monday", "Tuesday", "Wednesday",
                                                   "Thursday", "Friday", "Saturday"};

bool IsWithin(const TimeSpan& span, double least, double greatest) {
  return span.first >= least && span.last <= greatest;
}

bool IsOfDay(const TimeSpan& span) { return IsWithin(span, 0, kLastOfDay) && span.first < kSecondsPerDay; }

std::string Describe(PointTimeForm form) {
  return form == PointTimeForm::kWeekSeconds ? "seconds of the GPS week" : "adjusted standard GPS times";
}

PointClock Adjusted(TimeFormat format, double scale, double shift, std::string description) {
  return {format, scale, shift, PointTimeForm::kAdjustedStandard, std::move(description)};
}

// Those of times of which one is `scale` seconds; `span` is in seconds. Clocks whose dates no survey has are left out.
void AddClocks(const TimeSpan& span, double scale, double leap_seconds, bool named, std::vector<PointClock>& clocks) {
  const bool seconds = scale == 1;
  const std::string unit = seconds ? "seconds" : "milliseconds";
  const auto format = [&](TimeFormat in_seconds) { return seconds ? in_seconds : TimeFormat::kMilliseconds; };
  if (MayBeOfWeek(span)) {
    clocks.push_back(
        {format(TimeFormat::kWeek), scale, 0, PointTimeForm::kWeekSeconds, absl::StrCat(unit, " of the GPS week")});
  }
  if (IsWithin(span, kEarliest - kAdjustedGpsOffset, kLatest - kAdjustedGpsOffset)) {
    clocks.push_back(Adjusted(format(TimeFormat::kAdjusted), scale, 0,
                              seconds ? "adjusted standard GPS times" : "adjusted standard GPS times in milliseconds"));
  }
  if (IsWithin(span, kEarliest, kLatest)) {
    clocks.push_back(
        Adjusted(format(TimeFormat::kGps), scale, -kAdjustedGpsOffset, absl::StrCat("GPS ", unit, " since 1980")));
  }
  if (IsWithin(span, kEarliest + kGpsEpoch, kLatest + kGpsEpoch)) {
    const double leap = LeapSecondsAtUtc(span.first - kGpsEpoch);
    clocks.push_back(
        Adjusted(format(TimeFormat::kUnix), scale, leap - kGpsEpoch - kAdjustedGpsOffset, absl::StrCat("Unix ", unit)));
  }
  // Seconds of a day that continue beyond its end are seconds of another day of the week, too.
  if (!(IsOfDay(span) || (named && IsWithin(span, 0, kLastOfDay)))) return;
  for (std::size_t day = 0; day < kDays.size(); ++day) {
    clocks.push_back({format(TimeFormat::kDay), scale, kSecondsPerDay * static_cast<double>(day),
                      PointTimeForm::kWeekSeconds, absl::StrCat(unit, " of the day, a ", std::string(kDays[day]))});
  }
  for (std::size_t day = 0; day < kDays.size() && seconds; ++day) {
    clocks.push_back({TimeFormat::kUtcDay, 1, kSecondsPerDay * static_cast<double>(day) + leap_seconds,
                      PointTimeForm::kWeekSeconds,
                      absl::StrCat("UTC seconds of the day, a ", std::string(kDays[day]))});
  }
}

bool ReadsAlike(const PointClock& a, const PointClock& b) {
  return a.scale == b.scale && a.shift == b.shift && a.form == b.form;
}

}  // namespace

bool MayBeOfWeek(const TimeSpan& stated) { return IsWithin(stated, 0, kLastOfWeek); }

bool MayBeOfDay(const TimeSpan& stated) { return IsOfDay(stated) && stated.last - stated.first <= kSecondsPerDay; }

bool IsHeaderPlausible(const PointTimes& stated) {
  if (stated.form != PointTimeForm::kAdjustedStandard || !stated.created.has_value()) return false;
  // The date of the header is that of some place, up to half a day from UTC.
  const double latest = *stated.created + 1.5 * kSecondsPerDay;
  return IsWithin(stated.span, kEarliest - kAdjustedGpsOffset, latest - kAdjustedGpsOffset) &&
         !MayBeOfWeek(stated.span);
}

std::string HourText(double seconds) {
  const int second = static_cast<int>(std::floor(seconds - kSecondsPerDay * std::floor(seconds / kSecondsPerDay)));
  return absl::StrFormat("%02d:%02d:%02d", second / 3600, second / 60 % 60, second % 60);
}

std::string HoursText(const TimeSpan& seconds) {
  return absl::StrCat(HourText(seconds.first), " to ", HourText(seconds.last));
}

std::string DayOfWeek(double time) {
  const double day = std::floor(time / kSecondsPerDay);
  return std::string(kDays[static_cast<std::size_t>(day - 7 * std::floor(day / 7))]);  // GPS time began on a Sunday.
}

std::vector<PointClock> ClocksOf(const PointTimes& stated, TimeFormat format, std::optional<double> date) {
  std::vector<PointClock> possible;
  if (!date.has_value()) date = stated.created;
  const double leap_seconds = date.has_value() ? *date + kGpsEpoch - UtcOfGps(*date) : kGpsMinusUtcNow;
  const bool named = format == TimeFormat::kDay || format == TimeFormat::kUtcDay;
  AddClocks(stated.span, 1, leap_seconds, named, possible);
  const TimeSpan milliseconds = {stated.span.first * kMillisecond, stated.span.last * kMillisecond};
  const double duration = std::max(milliseconds.last - milliseconds.first, kShortest);
  if (static_cast<double>(stated.count) <= kMostReturns * duration)
    AddClocks(milliseconds, kMillisecond, leap_seconds, named, possible);
  std::vector<PointClock> clocks;
  if (format == TimeFormat::kAuto) clocks.push_back({TimeFormat::kAuto, 1, 0, stated.form, Describe(stated.form)});
  for (PointClock& clock : possible) {
    if (format != TimeFormat::kAuto && clock.format != format) continue;
    // Seconds of the first day of the week are those of the week.
    const bool is_known =
        std::any_of(clocks.begin(), clocks.end(), [&](const PointClock& other) { return ReadsAlike(clock, other); });
    if (!is_known) clocks.push_back(std::move(clock));
  }
  return clocks;
}

std::string NameOf(TimeFormat format) { return std::string(kTimeFormatNames[static_cast<std::size_t>(format)]); }

std::string TimeFormatFlag(const PointClock& clock) { return absl::StrCat("--time-format ", NameOf(clock.format)); }

std::string ClocksText(std::span<const PointClock> clocks) {
  return absl::StrJoin(clocks, " or as ",
                       [](std::string* text, const PointClock& clock) { absl::StrAppend(text, clock.description); });
}

std::string ClockNote(const PointClock& clock, const PointTimes& stated, const std::string& fitting) {
  return absl::StrCat("the GPS times of the points are ", clock.description, ", not ", Describe(stated.form),
                      " as their file states: only so does ", fitting, " lie at the points; ", TimeFormatFlag(clock),
                      " says so");
}

}  // namespace albtpu::formats
