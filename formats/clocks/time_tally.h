// How the times of points lie: which of them are far from all others, and whether they tell pulses apart.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/clocks/trajectory_time.h"

namespace albtpu::formats {

// Of times that are times (IsNoTime), in the unit of the file.
class TimeTally {
 public:
  void Add(double time);
  void Add(std::span<const double> times);
  // The times of two first returns that follow each other in the file.
  void AddPulses(double before, double time);
  void Merge(const TimeTally& other);

  // Times that lie less than a month from the next one of them.
  struct Group {
    std::uint64_t points = 0;
    TimeSpan span;
  };
  // The largest first. Empty where times are disorder.
  std::vector<Group> Groups() const;

  // The span of nearly all times, without a few that lie a month or more from them, as where software wrote a time of
  // its own for points that it made. nullopt where there are no such few ones.
  std::optional<TimeSpan> Bulk() const;
  std::uint64_t outside_of_bulk() const;

  // Where most pulses have the time of another one, because times were rounded: the mean step between different times;
  // infinite where all are equal. nullopt otherwise.
  std::optional<double> CoarseStep() const;

 private:
  struct Day {
    std::uint64_t points = 0;
    TimeSpan span;
  };
  void AddToDay(std::uint64_t points, const TimeSpan& span);
  Group Largest() const;

  std::map<std::int64_t, Day> days_;
  std::uint64_t points_ = 0;
  bool has_too_many_days_ = false;
  std::uint64_t pulses_ = 0, equal_ = 0, steps_ = 0;
  double sum_of_steps_ = 0;
};

// For the user, where the times of a file are rounded so that positions of the sensor suffer by it; else empty. Fails
// where they do not tell where the sensor was. `name`: of the file. `seconds`: of a unit of the times.
absl::StatusOr<std::string> TimeStepNote(const std::string& name, const TimeTally& tally, double seconds);

}  // namespace albtpu::formats
