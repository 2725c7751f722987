#include "formats/clocks/dated_clock.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

constexpr double kHalfDay = kSecondsPerDay / 2;
// s; a flight of less than 6 hours over midnight seems to be longer.
constexpr double kLongestOfDay = 0.75 * kSecondsPerDay;

// s; sources in UTC are read as GPS time where nothing changes within the seconds between the two.
constexpr double kSameInstant = 60;

std::string SpanText(const TimeSpan& utc) {
  return absl::StrFormat("%s to %s", UtcText(GpsOfUtc(utc.first)), UtcText(GpsOfUtc(utc.last)));
}

double WeekOf(double adjusted) { return std::floor((adjusted + kAdjustedGpsOffset) / kSecondsPerWeek); }

TimeSpan SpanOf(const DatedClock& clock, const TimeSpan& stated) { return {clock(stated.first), clock(stated.last)}; }

// Seconds of the week that start again from 0 where the next one begins.
bool BeginAgain(const PointTimes& points) {
  const TimeSpan& span = points.span;
  return points.form == PointTimeForm::kWeekSeconds && MayBeOfWeek(span) &&
         span.last - span.first > kSecondsPerWeek / 2;
}

std::vector<PointClock> ChosenClocks(const PointTimes& points, const ClockChoice& choice) {
  if (choice.of_track.has_value()) return {*choice.of_track};
  std::vector<PointClock> clocks = ClocksOf(points, choice.format);
  if (choice.format != TimeFormat::kAuto) return clocks;
  if (IsHeaderPlausible(points)) clocks.resize(1);
  if (MayBeOfWeek(points.span)) std::erase_if(clocks, [](const PointClock& each) { return each.scale != 1; });
  return clocks;
}

// Seconds of a day that start again from 0 at midnight.
bool BeginAgainAtMidnight(const PointClock& clock, const PointTimes& points) {
  const TimeSpan span = {clock.scale * points.span.first, clock.scale * points.span.last};
  return clock.is_of_day() && span.last <= kSecondsPerDay && span.last - span.first > kLongestOfDay;
}

std::vector<DatedClock> FittingClocks(const PointTimes& points, const ClockChoice& choice, const TimeSpan& known) {
  std::vector<DatedClock> fitting;
  const auto add = [&](const PointClock& clock, double shift) {
    const DatedClock dated = {clock, clock.scale, shift};
    const TimeSpan span = SpanOf(dated, points.span);
    if (Overlap(span, known) >= (span.last - span.first) / 2) fitting.push_back(dated);
  };
  for (const PointClock& clock : ChosenClocks(points, choice)) {
    // Nothing that has dates changes within the seconds between UTC and GPS.
    if (choice.is_open() && clock.format == TimeFormat::kUtcDay) continue;
    if (BeginAgainAtMidnight(clock, points)) continue;
    if (clock.form == PointTimeForm::kAdjustedStandard) {
      add(clock, clock.shift);
      continue;
    }
    // Times that begin again from 0 have two weeks.
    if (clock.scale * (points.span.last - points.span.first) > kSecondsPerWeek / 2) continue;
    for (double week = WeekOf(known.first) - 1; week <= WeekOf(known.last); ++week)
      add(clock, clock.shift + week * kSecondsPerWeek - kAdjustedGpsOffset);
  }
  return fitting;
}

std::string DateOf(double adjusted) { return DateText(adjusted + kAdjustedGpsOffset); }

std::string DatedText(const DatedClock& clock, const PointTimes& points) {
  return absl::StrCat(clock.clock.description, " (", DateOf(clock(points.span.first)), ")");
}

// Leaves those that the creation of the file allows, and says so. People export points days or years after the flight,
// so that another day than that of the creation is no contradiction; an earlier creation is one, of the date.
void KeepByCreation(const PointTimes& points, std::vector<DatedClock>& clocks, std::string& evidence) {
  if (clocks.size() < 2 || !points.created.has_value()) return;
  const double created = *points.created - kAdjustedGpsOffset;
  // The date is that of the place of the survey, up to half a day from UTC.
  const auto keep = [&](double earliest, double latest) {
    std::vector<DatedClock> kept;
    for (const DatedClock& clock : clocks) {
      const double first = clock(points.span.first);
      if (first >= earliest && first < latest) kept.push_back(clock);
    }
    if (!kept.empty()) clocks = std::move(kept);
  };
  const std::size_t before = clocks.size();
  keep(-INFINITY, created + kSecondsPerDay + kHalfDay);
  if (clocks.size() > 1) keep(created, created + kSecondsPerDay);
  if (clocks.size() > 1) keep(created - kHalfDay, created + kSecondsPerDay + kHalfDay);
  if (clocks.size() < before)
    evidence = absl::StrCat("the creation of the file on ", DateOf(created + kHalfDay), " by its header");
}

// "2016-05-12T11:06:22Z by levels.csv"
std::string ReadingText(const ClockReading& reading, double stated) {
  const double time = reading(stated);
  if (reading.form == PointTimeForm::kWeekSeconds)
    return absl::StrCat(HourText(time), " of a ", DayOfWeek(time), " by ", reading.of);
  return absl::StrCat(InstantText(time + kAdjustedGpsOffset), " by ", reading.of);
}

bool AreSame(const ClockReading& a, const ClockReading& b, const PointTimes& points) {
  double apart = a(points.span.first) - b(points.span.first);
  if (a.form == PointTimeForm::kAdjustedStandard && b.form == PointTimeForm::kAdjustedStandard && !BeginAgain(points))
    return std::abs(apart) <= kSameInstant;
  // One of them does not name its week, or the points have two.
  if (a.form == PointTimeForm::kAdjustedStandard) apart += kAdjustedGpsOffset;
  if (b.form == PointTimeForm::kAdjustedStandard) apart -= kAdjustedGpsOffset;
  return std::abs(std::remainder(apart, kSecondsPerWeek)) <= kSameInstant;
}

}  // namespace

std::string ChoiceText(const ClockChoice& choice, const PointTimes& points) {
  const std::vector<PointClock> clocks = ChosenClocks(points, choice);
  const bool begin_again =
      std::ranges::any_of(clocks, [&](const PointClock& clock) { return BeginAgainAtMidnight(clock, points); });
  return absl::StrCat(
      choice.of_track.has_value()
          ? absl::StrCat("the times are ", choice.of_track->description, ", as the trajectory has them")
          : absl::StrCat("--time-format ", NameOf(choice.format), " is right"),
      begin_again ? " (by which they span more than 18 hours, as if they began again at midnight)" : "");
}

PointTimes Continued(PointTimes points) {
  if (BeginAgain(points)) points.span = {points.span.last, points.span.first + kSecondsPerWeek};
  return points;
}

absl::Status CheckReadingsAgree(const std::string& name, const PointTimes& points,
                                std::span<const ClockReading> readings) {
  const double first = points.span.first;
  for (std::size_t i = 1; i < readings.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (AreSame(readings[k], readings[i], points)) continue;
      return absl::FailedPreconditionError(
          absl::StrCat(name, ": its first point is at ", ReadingText(readings[k], first), ", but at ",
                       ReadingText(readings[i], first),
                       "; give both of the day of the flight, or say how the times of the points "
                       "are meant by --time-format"));
    }
  }
  return absl::OkStatus();
}

std::string CreationNote(const PointTimes& points, std::span<const ClockReading> readings) {
  if (!points.created.has_value()) return "";
  const double created = *points.created - kAdjustedGpsOffset;
  for (const ClockReading& reading : readings) {
    if (reading.form != PointTimeForm::kAdjustedStandard) continue;
    if (reading(points.span.first) < created + kSecondsPerDay + kHalfDay) continue;
    return absl::StrCat("the points were measured at ", ReadingText(reading, points.span.first),
                        ", after their file was created on ", DateOf(created + kHalfDay),
                        " by its header: one of the two is wrong");
  }
  return "";
}

absl::StatusOr<std::optional<DatedClock>> FindDatedClock(const PointTimes& points, const ClockChoice& choice,
                                                         const TimeSpan& known, const std::string& of,
                                                         std::string& note) {
  note.clear();
  if (choice.is_open() && BeginAgain(points)) return std::nullopt;
  std::vector<DatedClock> clocks = FittingClocks(points, choice, known);
  const auto is_other = [](const DatedClock& each) {
    return each.clock.format != TimeFormat::kAuto || each.clock.changes_times();
  };
  const auto is_in_milliseconds = [](const DatedClock& each) { return each.scale != 1; };
  // Where the header's clock fits, in whatever week, nothing contradicts it. Milliseconds are rare, and as such a
  // thousandth of the time fits in many places.
  if (choice.is_open() && !std::ranges::all_of(clocks, is_other)) std::erase_if(clocks, is_other);
  if (!std::ranges::all_of(clocks, is_in_milliseconds)) std::erase_if(clocks, is_in_milliseconds);
  if (clocks.empty()) return std::nullopt;
  std::string evidence;
  KeepByCreation(points, clocks, evidence);
  if (clocks.size() > 1) {
    return absl::FailedPreconditionError(absl::StrJoin(
        clocks, " or as ",
        [&](std::string* text, const DatedClock& each) { absl::StrAppend(text, DatedText(each, points)); }));
  }
  const DatedClock& found = clocks.front();
  if (choice.is_open() && is_other(found)) note = ClockNote(found.clock, points, of);
  if (!evidence.empty()) {
    if (note.empty()) note = absl::StrCat("the GPS times of the points are ", found.clock.description);
    absl::StrAppend(&note, "; of the dates that ", of, " has for them, ", DateOf(found(points.span.first)),
                    " is taken because of ", evidence);
  }
  return found;
}

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

absl::StatusOr<UtcClock> FindUtcClock(const std::string& name, const PointTimes& points, const ClockChoice& choice,
                                      const TimeSpan& known, const std::string& of, std::string& note) {
  note.clear();
  const absl::StatusOr<double> stated = UtcOffset(name, points, known, of);
  if (IsNoTime(points.span.first) && IsNoTime(points.span.last)) return stated.status();
  if (choice.keeps_header() && stated.ok()) return UtcClock{1, *stated};
  const TimeSpan adjusted = {GpsOfUtc(known.first) - kAdjustedGpsOffset, GpsOfUtc(known.last) - kAdjustedGpsOffset};
  const absl::StatusOr<std::optional<DatedClock>> found = FindDatedClock(points, choice, adjusted, of, note);
  if (!found.ok()) {
    if (!stated.ok())
      return absl::FailedPreconditionError(
          absl::StrCat(stated.status().message(), " (as ", found.status().message(), " they would lie within it)"));
    return absl::FailedPreconditionError(absl::StrCat(name, ": its points lie within ", of, " as ",
                                                      found.status().message(), "; choose an instant by --sea-time"));
  }
  if (!found->has_value()) {
    if (choice.keeps_header()) return stated.status();
    return absl::FailedPreconditionError(absl::StrCat(name, ": its points were measured outside of ", of, " if ",
                                                      ChoiceText(choice, points),
                                                      "; give the sea of that time, or another format"));
  }
  const double first = (**found)(points.span.first);
  return UtcClock{(*found)->scale, (*found)->shift + UtcOfGps(first + kAdjustedGpsOffset) - first};
}

}  // namespace albtpu::formats
