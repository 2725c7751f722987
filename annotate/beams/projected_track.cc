#include "annotate/beams/projected_track.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <mutex>
#include <numbers>
#include <utility>

#include "absl/strings/str_cat.h"
#include "formats/clocks/point_clock.h"
#include "formats/clocks/trajectory_time.h"

namespace albtpu::annotate {
namespace {

constexpr std::size_t kBlock = 4096;  // Steps between records.

// Convergence and scale are computed at every 16th record and are linear between: within 3.2 s, the longest time
// between two of them, an aircraft leaves the straight line by 6 m in a turn of 5 m/s^2, and both change by 1e-6 then.
constexpr std::size_t kMetricStep = 16;

}  // namespace

// In single precision where 1e-7 of the number is enough: 0.02 mm in 200 m.
struct ProjectedTrack::Row {
  double time;
  double x, y, z;
  float metres_per_x, metres_per_y, north_per_x, convergence;
};

struct ProjectedTrack::Block {
  std::size_t run = 0;
  std::size_t begin = 0, end = 0;  // Records; the last one is the first of the next block of the run.
  mutable std::once_flag once;
  mutable std::vector<Row> rows;
};

NorthEastDown Turned(const LeverArm& arm, double roll, double pitch, double heading) {
  // Roll turns about the forward axis, pitch about the right axis, heading about the down axis.
  const double right = arm.right * std::cos(roll) - arm.down * std::sin(roll);
  const double down = arm.right * std::sin(roll) + arm.down * std::cos(roll);
  const double forward = arm.forward * std::cos(pitch) + down * std::sin(pitch);
  return {forward * std::cos(heading) - right * std::sin(heading),
          forward * std::sin(heading) + right * std::cos(heading),
          -arm.forward * std::sin(pitch) + down * std::cos(pitch)};
}

ProjectedTrack::ProjectedTrack(formats::TrajectoryTimeline timeline, std::shared_ptr<const formats::MapFrame> frame,
                               const ProjectedTrackOptions& options)
    : timeline_(std::move(timeline)), frame_(std::move(frame)), options_(options) {
  const std::vector<formats::TimelineRun>& runs = timeline_.runs();
  starts_again_ = timeline_.points().form == formats::PointTimeForm::kWeekSeconds &&
                  runs.back().span().last >= formats::kSecondsPerWeek;
  const formats::TrajectoryRecord first = runs.front().trajectory->Record(runs.front().begin);
  first_x_ = frame_->Project({first.latitude, first.longitude}).x;
  std::size_t count = 0;
  for (const formats::TimelineRun& run : runs) count += (run.end - run.begin - 1 + kBlock - 1) / kBlock;
  blocks_ = std::make_unique<Block[]>(count);
  std::size_t block = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const formats::TimelineRun& run = runs[i];
    for (std::size_t begin = run.begin; begin + 1 < run.end; begin += kBlock) {
      blocks_[block].run = i;
      blocks_[block].begin = begin;
      blocks_[block].end = std::min(begin + kBlock + 1, run.end);
      // A run that overlaps the one before it is used from the end of that one.
      const bool follows = begin == run.begin && i > 0;
      begins_.push_back(follows ? std::max(run.TimeAt(begin), runs[i - 1].span().last) : run.TimeAt(begin));
      ++block;
    }
  }
  assert(block == count && std::is_sorted(begins_.begin(), begins_.end()));
}

ProjectedTrack::~ProjectedTrack() = default;

absl::StatusOr<std::unique_ptr<ProjectedTrack>> ProjectedTrack::Create(formats::TrajectoryTimeline timeline,
                                                                       std::shared_ptr<const formats::MapFrame> frame,
                                                                       const ProjectedTrackOptions& options) {
  if (!options.lever_arm.is_zero()) {
    for (const formats::TimelineRun& run : timeline.runs()) {
      const formats::TrajectoryRecord record = run.trajectory->Record(run.begin);
      if (!std::isfinite(record.roll + record.pitch + record.heading)) {
        return absl::InvalidArgumentError(
            absl::StrCat("--lever-arm: needs roll, pitch and heading, which ", run.trajectory->name(),
                         " does not state; give a trajectory with attitude, or leave the lever arm out"));
      }
    }
  }
  return std::unique_ptr<ProjectedTrack>(new ProjectedTrack(std::move(timeline), std::move(frame), options));
}

formats::GeographicPosition ProjectedTrack::SensorOf(const formats::TrajectoryRecord& record, double& height) const {
  height = record.height;
  if (options_.lever_arm.is_zero()) return {record.latitude, record.longitude};
  const NorthEastDown arm = Turned(options_.lever_arm, record.roll, record.pitch, record.heading);
  height = record.height - arm.down;
  const formats::Ellipsoid& ellipsoid = frame_->ellipsoid();
  const double meridian = ellipsoid.MeridianRadius(record.latitude) + record.height;
  const double parallel = (ellipsoid.PrimeVerticalRadius(record.latitude) + record.height) * std::cos(record.latitude);
  return {record.latitude + arm.north / meridian, record.longitude + arm.east / parallel};
}

SensorPosition ProjectedTrack::PositionOf(const formats::TrajectoryRecord& record) const {
  double height = 0;
  const formats::GeographicPosition sensor = SensorOf(record, height);
  const formats::MapPosition position = frame_->Project(sensor);
  const formats::MapMetric metric = frame_->MetricAt(sensor);
  return {.x = Continuous(position.x),
          .y = position.y,
          .z = height - options_.geoid_separation,
          .metres_per_x = metric.metres_per_x,
          .metres_per_y = metric.metres_per_y,
          .north_per_x = metric.north_per_x,
          .convergence = metric.convergence};
}

double ProjectedTrack::Continuous(double x) const {
  const double turn = frame_->turn();
  return turn > 0 ? first_x_ + std::remainder(x - first_x_, turn) : x;
}

std::vector<ProjectedTrack::Row> ProjectedTrack::Project(const Block& block) const {
  const formats::TimelineRun& run = timeline_.runs()[block.run];
  const std::size_t count = block.end - block.begin;
  std::vector<Row> rows(count);
  std::vector<formats::GeographicPosition> sensors(count);
  for (std::size_t i = 0; i < count; ++i) {
    double height = 0;
    sensors[i] = SensorOf(run.trajectory->Record(block.begin + i), height);
    rows[i].time = run.TimeAt(block.begin + i);
    rows[i].z = height - options_.geoid_separation;
  }
  std::vector<formats::MapPosition> positions(count);
  frame_->Project(sensors, positions);
  for (std::size_t i = 0; i < count; ++i) {
    rows[i].x = Continuous(positions[i].x);
    rows[i].y = positions[i].y;
  }
  formats::MapMetric first = frame_->MetricAt(sensors[0]);
  for (std::size_t i = 0; i + 1 < count; i += kMetricStep) {
    const std::size_t end = std::min(i + kMetricStep, count - 1);
    formats::MapMetric last = frame_->MetricAt(sensors[end]);
    last.convergence = first.convergence + std::remainder(last.convergence - first.convergence, 2 * std::numbers::pi);
    for (std::size_t j = i; j <= end; ++j) {
      const double fraction = (rows[j].time - rows[i].time) / (rows[end].time - rows[i].time);
      rows[j].metres_per_x = static_cast<float>(std::lerp(first.metres_per_x, last.metres_per_x, fraction));
      rows[j].metres_per_y = static_cast<float>(std::lerp(first.metres_per_y, last.metres_per_y, fraction));
      rows[j].north_per_x = static_cast<float>(std::lerp(first.north_per_x, last.north_per_x, fraction));
      rows[j].convergence = static_cast<float>(std::lerp(first.convergence, last.convergence, fraction));
    }
    first = last;
  }
  return rows;
}

const std::vector<ProjectedTrack::Row>& ProjectedTrack::RowsOf(std::size_t block) const {
  const Block& slot = blocks_[block];
  std::call_once(slot.once, [&] { slot.rows = Project(slot); });
  return slot.rows;
}

// The step of the last time: successive times are mostly in the same step or the next one.
class ProjectedTrack::Cursor {
 public:
  explicit Cursor(const ProjectedTrack& track) : track_(track) {}

  TrackOutcome operator()(double time, SensorPosition& position) {
    if (!(time >= block_begin_ && time < block_end_) && !EnterBlock(time)) return TrackOutcome::kOutside;
    const std::vector<Row>& rows = *rows_;
    if (!(time <= rows.back().time)) return TrackOutcome::kOutside;
    FindStep(time);
    const Row& first = rows[step_];
    const Row& second = rows[step_ + 1];
    const double fraction = (time - first.time) / (second.time - first.time);
    const auto between = [fraction](double a, double b) { return a + fraction * (b - a); };
    position.x = between(first.x, second.x);
    position.y = between(first.y, second.y);
    position.z = between(first.z, second.z);
    position.metres_per_x = between(first.metres_per_x, second.metres_per_x);
    position.metres_per_y = between(first.metres_per_y, second.metres_per_y);
    position.north_per_x = between(first.north_per_x, second.north_per_x);
    position.convergence = between(first.convergence, second.convergence);
    position.incidence_sigma = 0;
    // Outside the domain of the projection there is no position.
    return std::isfinite(position.x + position.y + position.metres_per_x + position.metres_per_y)
               ? TrackOutcome::kKnown
               : TrackOutcome::kOutside;
  }

 private:
  // False before the first block, and for a time that is not a number.
  bool EnterBlock(double time) {
    const std::vector<double>& begins = track_.begins_;
    if (!(time >= begins.front())) return false;
    const auto next = std::upper_bound(begins.begin(), begins.end(), time);
    rows_ = &track_.RowsOf(static_cast<std::size_t>(next - begins.begin()) - 1);
    block_begin_ = *(next - 1);
    block_end_ = next == begins.end() ? HUGE_VAL : *next;
    step_ = 0;
    return true;
  }

  // The last step that begins at or before `time`. Gallops from the last step, then halves.
  void FindStep(double time) {
    const std::vector<Row>& rows = *rows_;
    const std::size_t last = rows.size() - 2;
    std::size_t low = step_, high = step_;
    if (rows[low].time <= time) {
      for (std::size_t width = 1; high < last && rows[high + 1].time <= time; width *= 2) {
        low = high + 1;
        high = std::min(high + width, last);
        if (rows[high].time > time) break;
      }
    } else {
      for (std::size_t width = 1; low > 0 && rows[low].time > time; width *= 2) {
        high = low;
        low = low > width ? low - width : 0;
      }
    }
    while (low < high) {
      const std::size_t middle = low + (high - low + 1) / 2;
      if (rows[middle].time <= time)
        low = middle;
      else
        high = middle - 1;
    }
    step_ = low;
  }

  const ProjectedTrack& track_;
  const std::vector<Row>* rows_ = nullptr;
  double block_begin_ = HUGE_VAL, block_end_ = -HUGE_VAL;
  std::size_t step_ = 0;
};

void ProjectedTrack::PositionsAt(std::span<const double> times, std::span<SensorPosition> positions,
                                 std::span<TrackOutcome> outcomes) const {
  assert(times.size() == positions.size() && times.size() == outcomes.size());
  Cursor cursor(*this), cursor_of_next_week(*this);
  for (std::size_t i = 0; i < times.size(); ++i) {
    // Where seconds of the week begin again, 0 is a time as any other.
    if (formats::IsNoTime(times[i]) && !(starts_again_ && times[i] == 0)) {
      outcomes[i] = TrackOutcome::kOutside;
      continue;
    }
    outcomes[i] = cursor(times[i], positions[i]);
    if (starts_again_ && outcomes[i] == TrackOutcome::kOutside && times[i] < formats::kSecondsPerWeek)
      outcomes[i] = cursor_of_next_week(times[i] + formats::kSecondsPerWeek, positions[i]);
  }
}

}  // namespace albtpu::annotate
