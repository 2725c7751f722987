#include "annotate/beams/track_motions.h"

#include <array>
#include <cmath>

#include "sea/angle.h"

namespace albtpu::annotate {
namespace {

double Course(double north, double east) {
  const double course = DegreesOfRadians(std::atan2(east, north));
  return course < 0 ? course + 360 : course;
}

double Or(double stated, double otherwise) { return std::isfinite(stated) ? stated : otherwise; }

}  // namespace

std::optional<formats::TrajectorySigma> TrajectoryMotions::SigmaAt(double time) const {
  for (const formats::TimelineRun& run : timeline_.runs()) {
    if (!(time >= run.span().first && time <= run.span().last)) continue;
    for (const std::shared_ptr<const formats::SmrmsgFile>& file : errors_) {
      std::optional<formats::TrajectorySigma> sigma = file->SigmaAt(time - run.offset);
      if (sigma.has_value()) return sigma;
    }
    std::size_t low = run.begin, high = run.end - 1;  // The last record at or before `time`.
    while (low < high) {
      const std::size_t middle = low + (high - low + 1) / 2;
      (run.TimeAt(middle) <= time ? low : high) = run.TimeAt(middle) <= time ? middle : middle - 1;
    }
    return run.trajectory->SigmaAt(low);
  }
  return std::nullopt;
}

std::optional<SensorMotion> TrajectoryMotions::At(double time) const {
  const std::optional<formats::TrajectoryRecord> record = timeline_.RecordAt(time);
  if (!record.has_value()) return std::nullopt;
  SensorMotion motion;
  motion.velocity = {Or(record->velocity_north, 0), Or(record->velocity_east, 0),
                     -Or(record->velocity_up, 0)};
  motion.roll = DegreesOfRadians(Or(record->roll, 0));
  motion.pitch = DegreesOfRadians(Or(record->pitch, 0));
  motion.heading = std::isfinite(record->heading) ? DegreesOfRadians(record->heading)
                                                  : Course(motion.velocity[0], motion.velocity[1]);
  motion.rates = {DegreesOfRadians(Or(record->rate_forward, 0)), DegreesOfRadians(Or(record->rate_right, 0)),
                  DegreesOfRadians(Or(record->rate_down, 0))};
  if (const std::optional<formats::TrajectorySigma> sigma = SigmaAt(time); sigma.has_value()) {
    motion.position_sigma = {sigma->north, sigma->east, sigma->down};
    motion.attitude_sigma = {DegreesOfRadians(sigma->roll), DegreesOfRadians(sigma->pitch),
                             DegreesOfRadians(sigma->heading)};
  }
  return motion;
}

std::optional<SensorMotion> CourseMotions::At(double time) const {
  constexpr double kStep =
      0.1;  // s, over which the velocity is taken: twice as far where the track begins or ends.
  const std::array<double, 3> times = {time - kStep, time, time + kStep};
  std::array<SensorPosition, 3> positions;
  std::array<TrackOutcome, 3> outcomes;
  track_.PositionsAt(times, positions, outcomes);
  const std::size_t first = outcomes[0] == TrackOutcome::kKnown ? 0 : 1;
  const std::size_t last = outcomes[2] == TrackOutcome::kKnown ? 2 : 1;
  if (first == last || outcomes[1] != TrackOutcome::kKnown) return std::nullopt;
  const SensorPosition &from = positions[first], &to = positions[last];
  const double seconds = times[last] - times[first];
  const double x = (to.x - from.x) * from.metres_per_x / seconds,
               y = (to.y - from.y) * from.metres_per_y / seconds;
  // True azimuth = grid azimuth + convergence.
  const double c = std::cos(from.convergence), s = std::sin(from.convergence);
  SensorMotion motion;
  motion.velocity = {y * c - x * s, x * c + y * s, -(to.z - from.z) / seconds};
  motion.heading = Course(motion.velocity[0], motion.velocity[1]);
  return motion;
}

}  // namespace albtpu::annotate
