#include "formats/clocks/time_tally.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace albtpu::formats {
namespace {

constexpr double kBin = 86400;               // s
constexpr std::int64_t kFarthestDay = 1e12;  // Days beyond are one.
constexpr std::size_t kMostDays = 4096;      // Of a file; where there are more, times are disorder.
constexpr std::int64_t kDaysApart = 30;      // Days, between times of different surveys.
constexpr double kNearlyAll = 0.99;
constexpr std::uint64_t kFewPulses = 100;  // Fewer say nothing of how times were rounded.
constexpr double kLongestPulseStep = 60;   // s; a longer one is a pause between lines.

std::int64_t DayOf(double time) {
  const double day = std::floor(time / kBin);
  return static_cast<std::int64_t>(
      std::clamp(day, -static_cast<double>(kFarthestDay), static_cast<double>(kFarthestDay)));
}

}  // namespace

void TimeTally::Add(double time) {
  ++points_;
  AddToDay(1, {time, time});
}

void TimeTally::Add(std::span<const double> times) {
  if (times.empty()) return;
  const auto [first, last] = std::ranges::minmax(times);
  // Few files are of several days.
  if (DayOf(first) != DayOf(last)) {
    for (const double time : times) Add(time);
    return;
  }
  points_ += times.size();
  AddToDay(times.size(), {first, last});
}

void TimeTally::AddToDay(std::uint64_t points, const TimeSpan& span) {
  const std::int64_t number = DayOf(span.first);
  if (days_.size() >= kMostDays && !days_.contains(number)) {
    has_too_many_days_ = true;
    return;
  }
  Day& day = days_[number];
  day.span =
      day.points == 0 ? span : TimeSpan{std::min(day.span.first, span.first), std::max(day.span.last, span.last)};
  day.points += points;
}

void TimeTally::AddPulses(double before, double time) {
  const double step = std::abs(time - before);
  ++pulses_;
  equal_ += step == 0;
  if (step == 0 || step > kLongestPulseStep) return;
  ++steps_;
  sum_of_steps_ += step;
}

void TimeTally::Merge(const TimeTally& other) {
  for (const auto& [number, day] : other.days_) AddToDay(day.points, day.span);
  points_ += other.points_;
  has_too_many_days_ |= other.has_too_many_days_;
  pulses_ += other.pulses_;
  equal_ += other.equal_;
  steps_ += other.steps_;
  sum_of_steps_ += other.sum_of_steps_;
}

std::vector<TimeTally::Group> TimeTally::Groups() const {
  std::vector<Group> groups;
  if (has_too_many_days_) return groups;
  std::int64_t before = 0;
  for (const auto& [number, day] : days_) {
    if (groups.empty() || number - before > kDaysApart) groups.push_back({0, day.span});
    before = number;
    groups.back().points += day.points;
    groups.back().span.last = day.span.last;
  }
  std::ranges::stable_sort(groups, std::ranges::greater(), &Group::points);
  return groups;
}

TimeTally::Group TimeTally::Largest() const {
  const std::vector<Group> groups = Groups();
  return groups.empty() ? Group() : groups.front();
}

std::optional<TimeSpan> TimeTally::Bulk() const {
  if (has_too_many_days_) return std::nullopt;
  const Group largest = Largest();
  const double share = static_cast<double>(largest.points) / static_cast<double>(std::max<std::uint64_t>(points_, 1));
  if (largest.points == points_ || share < kNearlyAll) return std::nullopt;
  return largest.span;
}

std::uint64_t TimeTally::outside_of_bulk() const { return points_ - Largest().points; }

std::optional<double> TimeTally::CoarseStep() const {
  if (pulses_ < kFewPulses || 2 * equal_ <= pulses_) return std::nullopt;
  return steps_ > 0 ? sum_of_steps_ / static_cast<double>(steps_) : std::numeric_limits<double>::infinity();
}

absl::StatusOr<std::string> TimeStepNote(const std::string& name, const TimeTally& tally, double seconds) {
  // s. Rounding to such steps moves the sensor by up to half a step. At 60 m/s and 400 m, half of the longest is 6 m,
  // or 0.9 degrees of incidence; half of the noted one is 0.3 m, less than a footprint.
  constexpr double kLongestTimeStep = 0.2, kNotedTimeStep = 0.01;
  const std::optional<double> stated = tally.CoarseStep();
  if (!stated.has_value()) return "";
  const double step = *stated * seconds;
  if (step < kNotedTimeStep) return "";
  if (step <= kLongestTimeStep) {
    return absl::StrFormat(
        "the GPS times of the points are rounded: pulses share them, and they are %.2g s apart, so "
        "that positions of the sensor are off by up to %.2g s of flight",
        step, step / 2);
  }
  return absl::FailedPreconditionError(absl::StrCat(
      name, ": the GPS times of its points are rounded (",
      std::isfinite(step) ? absl::StrFormat("pulses share them, and they are %.3g s apart", step) : "all are equal",
      "), and do not tell where the sensor was; take the file with the times that the sensor's software wrote, or give "
      "--scanner or --incidence"));
}

}  // namespace albtpu::formats
