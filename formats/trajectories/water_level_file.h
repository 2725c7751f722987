// Water levels by time, such as a tide gauge states them: a CSV file with the columns `time` and `water_level`.
//
//     time,water_level                         time,water_level
//     2016-05-11T14:00:00Z,-23.02              146968200.0,-23.02
//     2016-05-11T14:06:00Z,-23.05              146968560.0,-23.05
//
// `time` is UTC in ISO 8601 with its Z, or a number: GPS time in the form in which the LAS file states it. One file has
// one of the two. `water_level` is in the unit and in the vertical datum of the heights of the points. Others are
// ignored. Cells may be separated and numbers written as in formats/csv/csv_dialect.h.
//
// Or a file of CO-OPS (coops_levels.h), which states neither its datum nor, mostly, its time zone and unit.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/trajectories/point_clock.h"
#include "formats/trajectories/trajectory_time.h"

namespace albtpu::formats {

// What a file of levels does not state, by the user.
struct LevelReference {
  std::optional<std::string> datum = {};      // "MLLW", by name.
  double offset = 0;                          // Added to levels, from that datum to that of the points, in their unit.
  std::optional<double> hours_from_utc = {};  // Of times that state no zone: local time - UTC.
};

class WaterLevelSeries {
 public:
  // s. Between levels further apart than this, there is no level. Gauges report every 6 to 60 minutes. In the middle of
  // two hours, a tide of 12.42 h departs from the straight line by up to 1 - cos(2 pi 1 h / 12.42 h) = 0.13 of its
  // amplitude.
  static constexpr double kLongestGap = 7200;

  // Reads the text of such a file. `name` is for messages. At least two levels at increasing times.
  static absl::StatusOr<WaterLevelSeries> Parse(std::string name, std::string text, PointTimeForm form,
                                                const LevelReference& reference = {});

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
  WaterLevelSeries() = default;

  // Whether the level at `time` lies between the levels `after` - 1 and `after`.
  bool IsBetween(double time, std::size_t after) const {
    return after > 0 && after < times_.size() && times_[after - 1] <= time && time <= times_[after];
  }
  double Continued(double stated) const;                // In the series' clock and weeks.
  std::optional<std::size_t> After(double time) const;  // IsBetween; nullopt outside of the series.
  std::optional<double> Between(double time, std::size_t after) const;

  std::vector<double> times_, levels_;
  bool crosses_week_ = false;  // Seconds of the week that continue beyond 604 800 s.
  bool has_dates_ = false;
  std::string description_;
  std::optional<double> metres_;  // Of the unit of the levels; absent: not stated.
  double offset_ = 0;             // As LevelReference.
  double scale_ = 1, shift_ = 0;  // Time of the series = scale (time of a point) + shift.

  friend class WaterLevelReader;
  friend absl::StatusOr<WaterLevelSeries> FindWaterLevels(const std::filesystem::path& path, const PointTimes& points,
                                                          TimeFormat format, const LevelReference& reference,
                                                          std::string& note);
};

// Reads a CSV file of water levels.
absl::StatusOr<WaterLevelSeries> ReadWaterLevels(const std::filesystem::path& path,
                                                 PointTimeForm form = PointTimeForm::kAdjustedStandard,
                                                 const LevelReference& reference = {});

// The same for the points of a file, by the clock that their header states. Where a file of dates has no level at their
// times by it, or several weeks of them, by FindDatedClock, which fills `note`. With another `format` than kAuto by
// that alone. Numbers in place of dates are in the form of the points, whatever it is.
absl::StatusOr<WaterLevelSeries> FindWaterLevels(const std::filesystem::path& path, const PointTimes& points,
                                                 TimeFormat format, const LevelReference& reference, std::string& note);

}  // namespace albtpu::formats
