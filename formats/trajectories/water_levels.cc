#include "formats/trajectories/water_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

std::string UtcOf(double adjusted) { return InstantText(adjusted + kAdjustedGpsOffset); }

// The clocks of dates, other than that of the points, by which numbers can be read as times.
std::vector<PointClock> ClocksOfDates(const TimeSpan& numbers, PointTimeForm form) {
  std::vector<PointClock> clocks = ClocksOf({numbers, form}, TimeFormat::kAuto);
  std::erase_if(clocks, [](const PointClock& clock) {
    return clock.format == TimeFormat::kAuto || clock.form != PointTimeForm::kAdjustedStandard;
  });
  return clocks;
}

}  // namespace

void WaterLevelSeries::TakeUnit(double metres_per_unit) {
  if (!metres_.has_value() || *metres_ == metres_per_unit) return;
  for (double& level : levels_) level = (level - offset_) * *metres_ / metres_per_unit + offset_;
  metres_ = metres_per_unit;
}

double WaterLevelSeries::Continued(double stated) const {
  const double time = scale_ * stated + shift_;
  return crosses_week_ && time < start() ? time + kSecondsPerWeek : time;
}

std::optional<std::size_t> WaterLevelSeries::After(double time) const {
  if (!(time >= start() && time <= end())) return std::nullopt;
  const auto after = std::upper_bound(times_.begin(), times_.end(), time) - times_.begin();
  return std::min(static_cast<std::size_t>(after), times_.size() - 1);
}

std::optional<double> WaterLevelSeries::Between(double time, std::size_t after) const {
  const double first = times_[after - 1], second = times_[after];
  if (time == first) return levels_[after - 1];
  if (time == second) return levels_[after];
  if (second - first > kLongestGap) return std::nullopt;
  const double weight = (time - first) / (second - first);
  return levels_[after - 1] + weight * (levels_[after] - levels_[after - 1]);
}

std::optional<double> WaterLevelSeries::At(double time) const {
  const double continued = Continued(time);
  const std::optional<std::size_t> after = After(continued);
  return after.has_value() ? Between(continued, *after) : std::nullopt;
}

void WaterLevelSeries::LevelsAt(std::span<const double> times, std::span<double> levels) const {
  std::size_t after = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double time = Continued(times[i]);
    std::optional<double> level;
    if (!IsBetween(time, after)) after = After(time).value_or(0);
    if (after > 0) level = Between(time, after);
    levels[i] = level.value_or(std::numeric_limits<double>::quiet_NaN());
  }
}

absl::StatusOr<WaterLevelSeries> WaterLevelSeries::In(PointTimeForm form) const {
  WaterLevelSeries series = *this;
  if (form != PointTimeForm::kWeekSeconds || !has_dates_) return series;
  if (end() - start() >= kSecondsPerWeek) {
    return absl::InvalidArgumentError(absl::StrCat(
        name_,
        ": covers more than a week, but the times of the points are seconds of a week that they do not name; give the "
        "levels of the week of the survey alone"));
  }
  const double week =
      std::floor((start() + kAdjustedGpsOffset) / kSecondsPerWeek) * kSecondsPerWeek - kAdjustedGpsOffset;
  for (double& time : series.times_) time -= week;
  series.week_ = week;
  series.crosses_week_ = series.times_.back() > kSecondsPerWeek;
  return series;
}

bool WaterLevelSeries::HasLevelsAt(const TimeSpan& points) const {
  const double first = Continued(points.first), last = Continued(points.last);
  return Overlap({std::min(first, last), std::max(first, last)}, {start(), end()}) >= 0;
}

// "2016-05-11T14:00:00Z to ...", or "1462975200.0 to ... s, as Unix seconds 2016-05-11T14:00:00Z to ...".
std::string WaterLevelSeries::TimesText() const {
  if (has_dates_) return absl::StrCat(UtcOf(start()), " to ", UtcOf(end()));
  std::string text = absl::StrFormat("%.1f to %.1f s", start(), end());
  // The form of the points is not asked for: it is tried already.
  for (const PointClock& clock : ClocksOfDates({start(), end()}, PointTimeForm::kWeekSeconds))
    if (clock.scale == 1)
      absl::StrAppend(&text, ", as ", clock.description, " ", UtcOf(clock(start())), " to ", UtcOf(clock(end())));
  return text;
}

std::optional<ClockReading> WaterLevelSeries::ReadingOf(const PointTimes& points) const {
  if (!has_dates_ || !HasLevelsAt(points.span)) return std::nullopt;
  const double first = scale_ * points.span.first + shift_;
  const bool is_in_second_week = crosses_week_ && first < start() && first + kSecondsPerWeek <= end();
  return ClockReading{
      .of = name_, .scale = scale_, .shift = shift_ + week_ + (is_in_second_week ? kSecondsPerWeek : 0)};
}

absl::StatusOr<WaterLevelSeries> WaterLevelSeries::ByNumbers(const PointTimes& points, const ClockChoice& choice,
                                                             std::string& note) const {
  struct Reading {
    PointClock clock;
    DatedClock of_points;
  };
  std::vector<Reading> readings;
  for (const PointClock& clock : ClocksOfDates({start(), end()}, points.form)) {
    std::string ignored;
    const absl::StatusOr<std::optional<DatedClock>> found =
        FindDatedClock(points, choice, {clock(start()), clock(end())}, name_, ignored);
    if (found.ok() && found->has_value()) readings.push_back({clock, **found});
  }
  if (readings.size() > 1) {
    return absl::FailedPreconditionError(absl::StrCat(
        name_, ": its times are numbers that lie at the points as ",
        absl::StrJoin(readings, " or as ",
                      [](std::string* text, const Reading& each) { absl::StrAppend(text, each.clock.description); }),
        "; write dates in UTC such as ", UtcOf(readings.front().clock(start()))));
  }
  WaterLevelSeries series = *this;
  if (readings.empty()) return series;
  const auto& [clock, of_points] = readings.front();
  for (double& time : series.times_) time = clock(time);
  series.crosses_week_ = false;
  series.has_dates_ = true;
  series.scale_ = of_points.scale;
  series.shift_ = of_points.shift;
  note = absl::StrCat("the times of ", name_, " are ", clock.description, " (", UtcOf(series.start()), " to ",
                      UtcOf(series.end()),
                      "), not times as the points have them: only so do its levels lie at the "
                      "points, whose GPS times are ",
                      of_points.clock.description, "; dates such as the former say so");
  return series;
}

absl::StatusOr<WaterLevelSeries> WaterLevelSeries::For(const PointTimes& points, const ClockChoice& choice,
                                                       std::string& note) const {
  note.clear();
  const auto noted = [&](WaterLevelSeries series) {
    if (note.empty() && !series.HasLevelsAt(points.span)) {
      note = absl::StrCat(name_, ": has no level at the times of the points: it has ", TimesText(), ", they have ",
                          DescribePointTimes(points),
                          "; give the levels of that time, with dates in UTC such as 2016-05-11T14:00:00Z");
    }
    return series;
  };
  absl::StatusOr<WaterLevelSeries> stated = In(points.form);
  if (!has_dates_) {
    if (stated->HasLevelsAt(points.span)) return stated;
    ASSIGN_OR_RETURN(WaterLevelSeries read, ByNumbers(points, choice, note));
    return noted(std::move(read));
  }
  // Over the end of a week, seconds of the week are those of several days: a clock that fits is found by chance.
  const bool keeps_week = stated.ok() && stated->crosses_week_ && MayBeOfWeek(points.span);
  if (stated.ok() && choice.keeps_header() && (keeps_week || stated->HasLevelsAt(points.span)))
    return noted(*std::move(stated));
  // Dates of more than a week are an error of seconds of a week alone.
  const absl::StatusOr<std::optional<DatedClock>> clock = FindDatedClock(points, choice, {start(), end()}, name_, note);
  if (!clock.ok()) {
    return absl::FailedPreconditionError(absl::StrCat(name_, ": covers the GPS times of the points as ",
                                                      clock.status().message(),
                                                      "; give the levels of the day of the survey alone"));
  }
  if (!clock->has_value()) {
    if (choice.keeps_header()) {
      if (!stated.ok()) return stated;
      return noted(*std::move(stated));
    }
    return absl::FailedPreconditionError(absl::StrCat(name_, ": has no level at the times of the points if ",
                                                      ChoiceText(choice, points),
                                                      "; give the levels of that time, or another --time-format"));
  }
  WaterLevelSeries series = *this;
  series.scale_ = (*clock)->scale;
  series.shift_ = (*clock)->shift;
  return series;
}

}  // namespace albtpu::formats
