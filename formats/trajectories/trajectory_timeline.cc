#include "formats/trajectories/trajectory_timeline.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "absl/strings/str_format.h"
#include "formats/crs/proj_crs.h"
#include "formats/trajectories/ascii_motion.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

// Times in an overlap at which two files are compared.
constexpr int kComparisons = 200;

// The first record at or after `time`; the end of the run if there is none.
std::size_t FirstOfRun(const TimelineRun& run, double time) {
  return FirstRecordFrom(run.begin, run.end, time, [&run](std::size_t i) { return run.TimeAt(i); });
}

std::optional<TrajectoryRecord> RecordOfRun(const TimelineRun& run, double time) {
  const std::size_t next = FirstOfRun(run, time);
  if (next == run.end) return std::nullopt;
  TrajectoryRecord second = run.trajectory->Record(next);
  second.time = run.TimeAt(next);
  if (second.time == time) return second;
  if (next == run.begin) return std::nullopt;
  TrajectoryRecord first = run.trajectory->Record(next - 1);
  first.time = run.TimeAt(next - 1);
  if (!(second.time - first.time <= kLongestStep)) return std::nullopt;
  return Interpolate(first, second, time);
}

double Distance(const TrajectoryRecord& a, const TrajectoryRecord& b) {
  const Ellipsoid ellipsoid;
  const double north = ellipsoid.MeridianRadius(a.latitude) * (b.latitude - a.latitude);
  const double east = ellipsoid.PrimeVerticalRadius(a.latitude) * std::cos(a.latitude) *
                      std::remainder(b.longitude - a.longitude, 2 * std::numbers::pi);
  return std::hypot(north, east, b.height - a.height);
}

absl::Status CheckOverlap(const TimelineRun& a, const TimelineRun& b) {
  const TimeSpan overlap = {std::max(a.span().first, b.span().first), std::min(a.span().last, b.span().last)};
  if (!(overlap.last > overlap.first)) return absl::OkStatus();
  double largest = 0, at = 0;
  for (int i = 0; i < kComparisons; ++i) {
    const double time = overlap.first + (overlap.last - overlap.first) * (i + 0.5) / kComparisons;
    const std::optional<TrajectoryRecord> of_a = RecordOfRun(a, time), of_b = RecordOfRun(b, time);
    if (!of_a.has_value() || !of_b.has_value()) continue;
    const double distance = Distance(*of_a, *of_b);
    if (distance > largest) {
      largest = distance;
      at = time;
    }
  }
  if (largest <= kLargestContradiction) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrFormat(
      "%s: contradicts %s: at %.3f s their positions are %.2f m apart (limit %.1f m; two flights, or two "
      "solutions of one); give one trajectory for each time",
      b.trajectory->name(), a.trajectory->name(), at - a.offset, largest, kLargestContradiction));
}

// Further than the times of points are moved to find out whether a trajectory has the wrong clock, s. GPS - UTC is 18.
constexpr double kLongestClockError = 30;

// The records that points may ask for, with a record before and after them.
TimelineRun AtTimesOf(const PointTimes& points, TimelineRun run) {
  // Seconds of the week that start again from 0 belong to two weeks.
  const bool starts_again = points.form == PointTimeForm::kWeekSeconds && run.span().last >= kSecondsPerWeek;
  if (starts_again) return run;
  const std::size_t first = FirstOfRun(run, points.span.first - kLongestClockError);
  const std::size_t last = FirstOfRun(run, points.span.last + kLongestClockError);
  run.begin = std::max(first, run.begin + 1) - 1;
  run.end = std::min(last + 2, run.end);
  return run;
}

// Appends the parts of a run between gaps.
void AppendWithoutGaps(const TimelineRun& run, std::vector<TimelineRun>& parts) {
  TimelineRun part = run;
  for (std::size_t i = run.begin + 1; i <= run.end; ++i) {
    if (i < run.end && run.TimeAt(i) - run.TimeAt(i - 1) <= kLongestStep) continue;
    part.end = i;
    if (part.end - part.begin >= 2) parts.push_back(part);
    part.begin = i;
  }
}

absl::Status CheckOverlaps(const std::vector<TimelineRun>& sorted) {
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double end = sorted[i].span().last;
    for (std::size_t j = i + 1; j < sorted.size() && sorted[j].span().first < end; ++j)
      RETURN_IF_ERROR(CheckOverlap(sorted[i], sorted[j]));
  }
  return absl::OkStatus();
}

// The parts in order, without the overlap of each with the one before.
std::vector<TimelineRun> WithoutRepetition(const std::vector<TimelineRun>& sorted) {
  std::vector<TimelineRun> runs;
  for (TimelineRun run : sorted) {
    if (!runs.empty()) {
      const double end = runs.back().span().last;
      if (run.span().last <= end) continue;
      // From the record at or before the end of the run before it, so that no time between the two is lost.
      const std::size_t after = FirstOfRun(run, end);
      run.begin = std::max(after, run.begin + 1) - 1;
    }
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace

TrajectoryRecord Interpolate(const TrajectoryRecord& first, const TrajectoryRecord& second, double time) {
  const double fraction = (time - first.time) / (second.time - first.time);
  const auto linear = [&](double TrajectoryRecord::*value) {
    return first.*value + fraction * (second.*value - first.*value);
  };
  const auto angle = [&](double TrajectoryRecord::*value) {
    return first.*value + fraction * std::remainder(second.*value - first.*value, 2 * std::numbers::pi);
  };
  TrajectoryRecord record;
  record.time = time;
  record.latitude = linear(&TrajectoryRecord::latitude);
  record.longitude = angle(&TrajectoryRecord::longitude);
  record.height = linear(&TrajectoryRecord::height);
  record.velocity_north = linear(&TrajectoryRecord::velocity_north);
  record.velocity_east = linear(&TrajectoryRecord::velocity_east);
  record.velocity_up = linear(&TrajectoryRecord::velocity_up);
  record.roll = angle(&TrajectoryRecord::roll);
  record.pitch = angle(&TrajectoryRecord::pitch);
  record.heading = angle(&TrajectoryRecord::heading);
  record.rate_forward = linear(&TrajectoryRecord::rate_forward);
  record.rate_right = linear(&TrajectoryRecord::rate_right);
  record.rate_down = linear(&TrajectoryRecord::rate_down);
  return record;
}

absl::StatusOr<TrajectoryTimeline> TrajectoryTimeline::Create(const TrajectoryFiles& files, TrajectoryClock clock,
                                                              const PointTimes& points) {
  if (files.empty()) return absl::InvalidArgumentError("--trajectory: no file; give one or more trajectories");
  std::vector<TimelineRun> parts;
  std::optional<TimelineRun> kept;
  absl::Status no_overlap;
  const auto offset_of = [&](const Trajectory& file) {
    return TimeOffset(file.name(), {file.TimeAt(0), file.TimeAt(file.size() - 1)}, clock, points);
  };
  for (const std::size_t i : files.NearTimesOf(points)) {
    const std::shared_ptr<const Trajectory>& file = files[i];
    const absl::StatusOr<double> offset = offset_of(*file);
    if (!offset.ok()) {
      if (no_overlap.ok()) no_overlap = offset.status();
      continue;
    }
    kept = AtTimesOf(points, {file, *offset, 0, file->size()});
    AppendWithoutGaps(*kept, parts);
  }
  if (!kept.has_value() && no_overlap.ok()) no_overlap = offset_of(*files.front()).status();
  if (!kept.has_value() && no_overlap.ok())  // Its seconds vanish beside times that are too large.
    no_overlap = absl::InvalidArgumentError(absl::StrFormat("%s: no record at the times of the points, %s",
                                                            files.front()->name(), DescribePointTimes(points)));
  if (!kept.has_value() && files.size() == 1) return no_overlap;
  if (!kept.has_value()) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "--trajectory: none of %d trajectories has records at the times of the points; the first of them: %s",
        files.size(), no_overlap.message()));
  }
  if (parts.empty()) {
    return absl::InvalidArgumentError(
        absl::StrFormat("%s: its records at the times of the points are more than 0.2 s apart (the first two "
                        "%.3f s), and nothing is "
                        "interpolated over a longer step; export the trajectory at 5 Hz or more",
                        kept->trajectory->name(), kept->TimeAt(kept->begin + 1) - kept->TimeAt(kept->begin)));
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const TimelineRun& a, const TimelineRun& b) { return a.span().first < b.span().first; });
  RETURN_IF_ERROR(CheckOverlaps(parts));
  TrajectoryTimeline timeline(points);
  timeline.runs_ = WithoutRepetition(parts);
  return timeline;
}

std::optional<TrajectoryRecord> TrajectoryTimeline::RecordAt(double time) const {
  const auto record_at = [this](double at) -> std::optional<TrajectoryRecord> {
    for (const TimelineRun& run : runs_)
      if (std::optional<TrajectoryRecord> record = RecordOfRun(run, at)) return record;
    return std::nullopt;
  };
  if (std::optional<TrajectoryRecord> record = record_at(time)) return record;
  const bool starts_again = points_.form == PointTimeForm::kWeekSeconds && time >= 0 && time < kSecondsPerWeek &&
                            runs_.back().span().last >= kSecondsPerWeek;
  return starts_again ? record_at(time + kSecondsPerWeek) : std::nullopt;
}

}  // namespace albtpu::formats
