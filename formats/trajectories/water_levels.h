// Water levels by time, and the clock by which they belong to the points of a file.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/clocks/dated_clock.h"
#include "formats/clocks/trajectory_time.h"

namespace albtpu::formats {

class WaterLevelSeries {
 public:
  // s. Between levels further apart than this, there is no level. Gauges report every 6 to 60 minutes. In the middle of
  // two hours, a tide of 12.42 h departs from the straight line by up to 1 - cos(2 pi 1 h / 12.42 h) = 0.13 of its
  // amplitude.
  static constexpr double kLongestGap = 7200;

  // The same for times of points in this form, if the file has dates: for seconds of a week, those of the week in which
  // it begins. Fails where it covers more than one, because the points do not name theirs.
  absl::StatusOr<WaterLevelSeries> In(PointTimeForm form) const;

  // The same for the points of a file, by the clock that their header states. Where a file of dates has no level at
  // their times by it, or several weeks of them, by FindDatedClock; with a choice by that alone.
  // Numbers in place of dates are in the form of the points, whatever it is; where they have no level at their times,
  // the one clock of dates by which they have. `note`: what was found, or that there is no level at their times; else
  // empty.
  absl::StatusOr<WaterLevelSeries> For(const PointTimes& points, const ClockChoice& choice, std::string& note) const;

  // How the levels read the times of points, where they have dates and levels at these times.
  std::optional<ClockReading> ReadingOf(const PointTimes& points) const;

  const std::string& name() const { return name_; }
  std::size_t size() const { return times_.size(); }
  double start() const { return times_.front(); }
  double end() const { return times_.back(); }

  // Whether the file has dates, and not times in the form of the points.
  bool has_dates() const { return has_dates_; }

  // What the levels are and are relative to, for the user: "8723214 Virginia Key (CO-OPS), relative to MLLW, ...".
  // Empty where the file is of levels as the points have them.
  const std::string& description() const { return description_; }

  // Levels of a file that states its unit become those in a unit of `metres_per_unit`. Others have it already.
  void TakeUnit(double metres_per_unit);

  // Of a unit of the points' times.
  double seconds() const { return scale_; }

  // The level at a time of the points, linear between the two levels around it. nullopt before the first, after the
  // last, and in a gap.
  std::optional<double> At(double time) const;

  // The same for many times, NaN where there is no level. Fast where times that follow each other are close.
  void LevelsAt(std::span<const double> times, std::span<double> levels) const;

 private:
  friend class WaterLevelReader;

  WaterLevelSeries() = default;

  // Whether the level at `time` lies between the levels `after` - 1 and `after`.
  bool IsBetween(double time, std::size_t after) const {
    return after > 0 && after < times_.size() && times_[after - 1] <= time && time <= times_[after];
  }
  double Continued(double stated) const;                // In the series' clock and weeks.
  std::optional<std::size_t> After(double time) const;  // IsBetween; nullopt outside of the series.
  std::optional<double> Between(double time, std::size_t after) const;

  // The series of numbers whose times `clock` reads, for points of a clock that fits them.
  absl::StatusOr<WaterLevelSeries> ByNumbers(const PointTimes& points, const ClockChoice& choice,
                                             std::string& note) const;
  bool HasLevelsAt(const TimeSpan& points) const;
  std::string TimesText() const;

  std::string name_;
  std::vector<double> times_, levels_;
  bool crosses_week_ = false;  // Seconds of the week that continue beyond 604 800 s.
  bool has_dates_ = false;
  double week_ = 0;  // s; what In() took from the times: adjusted standard GPS time of the beginning of their week.
  std::string description_;
  std::optional<double> metres_;  // Of the unit of the levels; absent: not stated.
  double offset_ = 0;             // As LevelReference.
  double scale_ = 1, shift_ = 0;  // Time of the series = scale (time of a point) + shift.
};

}  // namespace albtpu::formats
