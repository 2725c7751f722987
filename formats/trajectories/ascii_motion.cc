#include "formats/trajectories/ascii_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "formats/crs/proj_crs.h"
#include "sea/angle.h"

namespace albtpu::formats {
namespace {

// A record with its position in the map frame; that is 0, 0 where the file has none.
struct Sample {
  TrajectoryRecord record;
  GridPosition grid;
};
using SamplePair = std::pair<Sample, Sample>;

using GridPositions = std::function<std::optional<GridPosition>(std::size_t)>;

std::vector<SamplePair> Samples(const Trajectory& trajectory, const GridPositions& grid_position) {
  const auto sample = [&](std::size_t i) {
    return Sample{trajectory.Record(i), grid_position(i).value_or(GridPosition{})};
  };
  std::vector<SamplePair> pairs;
  for (const RecordPair& pair : SpreadPairs(trajectory)) pairs.emplace_back(sample(pair.first), sample(pair.second));
  return pairs;
}

// The value below which a fraction of the values lie; 0 without values.
double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}
double Median(std::vector<double> values) { return Quantile(std::move(values), 0.5); }

double AngleBetween(double a, double b) { return std::abs(std::remainder(a - b, 2 * std::numbers::pi)); }

// The statistics that are checked. Angles in rad, speeds in m/s.
struct Motion {
  double speed = 0;       // Median.
  double fast_speed = 0;  // A tenth of the stretches are faster: an aircraft may have waited on the ground.
  double crab = 0;        // Median difference of heading and course.
  double grid_turn = 0;   // Median difference of the course in the map frame and that of longitude and latitude.
  std::optional<double> velocity_difference;  // Rms, where velocities are stated.

  bool speed_fits() const { return fast_speed >= kSlowestFlight && speed <= kFastestFlight; }
  bool crab_fits() const { return crab <= kLargestCrab; }
  bool velocity_fits() const {
    return !velocity_difference.has_value() || *velocity_difference <= kLargestVelocityDifference;
  }
  // Convergence of meridians is below 4 degrees in UTM, and below 15 in any frame of a survey.
  bool grid_fits() const { return grid_turn <= RadiansOfDegrees(15); }
  bool fits() const { return speed_fits() && crab_fits() && velocity_fits(); }
};

Motion MotionOf(std::span<const SamplePair> pairs) {
  std::vector<double> speeds, crabs, turns;
  std::vector<VelocityPair> velocities;
  for (const auto& [first, second] : pairs) {
    const VelocityPair velocity = CompareVelocities(first.record, second.record);
    velocities.push_back(velocity);
    speeds.push_back(std::hypot(velocity.north, velocity.east));
    const double course = std::atan2(velocity.east, velocity.north);
    if (speeds.back() >= kCrabSpeed) crabs.push_back(AngleBetween(first.record.heading, course));
    const double x = second.grid.x - first.grid.x, y = second.grid.y - first.grid.y;
    if (speeds.back() >= kSlowestFlight && (x != 0 || y != 0)) turns.push_back(AngleBetween(std::atan2(x, y), course));
  }
  const bool states_velocities = std::isfinite(pairs.front().first.record.velocity_north);
  return {.speed = Median(speeds),
          .fast_speed = Quantile(speeds, 0.9),
          .crab = Median(crabs),
          .grid_turn = Median(turns),
          .velocity_difference = states_velocities ? std::optional(VelocityDifference(velocities)) : std::nullopt};
}

bool CanBeLatitude(double angle) { return std::abs(angle) <= std::numbers::pi / 2; }

// Mistakes that occur. Each function undoes one in a sample, and is false if the sample cannot have it.
struct MotionMistake {
  const char* message;
  bool (*undo)(Sample& sample);
};

constexpr MotionMistake kMotionMistakes[] = {
    {"latitude and longitude are in radians; write degrees",
     [](Sample& sample) {
       sample.record.latitude = DegreesOfRadians(sample.record.latitude);
       sample.record.longitude = DegreesOfRadians(sample.record.longitude);
       return CanBeLatitude(sample.record.latitude) && std::abs(sample.record.longitude) <= std::numbers::pi;
     }},
    {"latitude and longitude are exchanged; write the columns in the documented order",
     [](Sample& sample) {
       std::swap(sample.record.latitude, sample.record.longitude);
       return CanBeLatitude(sample.record.latitude);
     }},
    {"headings are in radians; write degrees",
     [](Sample& sample) {
       sample.record.heading = DegreesOfRadians(sample.record.heading);
       return std::abs(sample.record.heading) <= 2 * std::numbers::pi;
     }},
    {"X and Y are exchanged; write the columns in the documented order",
     [](Sample& sample) {
       std::swap(sample.grid.x, sample.grid.y);
       return true;
     }},
};

// The motion after undoing a mistake; nullopt if the samples cannot have it.
std::optional<Motion> Undo(const MotionMistake& mistake, std::vector<SamplePair> pairs) {
  for (auto& [first, second] : pairs)
    if (!mistake.undo(first) || !mistake.undo(second)) return std::nullopt;
  return MotionOf(pairs);
}

std::string Describe(const Motion& motion) {
  if (!motion.speed_fits()) {
    return absl::StrFormat(
        "the positions move with %.3g m/s (an aircraft flies %g to %g m/s); check the units and the "
        "order of the columns",
        motion.speed, kSlowestFlight, kFastestFlight);
  }
  if (!motion.velocity_fits()) {
    return absl::StrFormat(
        "its velocities differ from differences of its positions by %.1f m/s rms (the limit is %g "
        "m/s); check the order of the columns",
        *motion.velocity_difference, kLargestVelocityDifference);
  }
  return absl::StrFormat(
      "heading and course over ground differ by %.0f degrees in the median; write the true heading "
      "of the nose, clockwise from north, in degrees",
      DegreesOfRadians(motion.crab));
}

// Two solutions that were joined differ by metres at most, and survey aircraft are slower.
constexpr double kLongestJump = 20;   // m
constexpr double kFastestJump = 400;  // m/s

constexpr std::size_t kMaxPairs = 4096;
constexpr double kStretch = 0.1;         // s
constexpr std::size_t kMaxSteps = 1000;  // In a stretch: disorder costs no more time than order.

}  // namespace

absl::Status CheckMotion(const Trajectory& trajectory, const GridPositions& grid_position) {
  const std::vector<SamplePair> pairs = Samples(trajectory, grid_position);
  if (pairs.empty()) return absl::OkStatus();
  const Motion motion = MotionOf(pairs);
  if (motion.fits() && motion.grid_fits()) return absl::OkStatus();
  for (const MotionMistake& mistake : kMotionMistakes) {
    const std::optional<Motion> undone = Undo(mistake, pairs);
    if (undone.has_value() && undone->fits() && undone->grid_fits())
      return absl::InvalidArgumentError(absl::StrCat(trajectory.name(), ": ", mistake.message));
  }
  // X and Y alone are checked later, with the map frame.
  if (motion.fits()) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(trajectory.name(), ": ", Describe(motion)));
}

absl::Status CheckJumps(const Trajectory& trajectory, const std::function<TrajectoryRecord(std::size_t)>& place_at) {
  constexpr double kEarthRadius = 6.371e6;  // m; a jump is known to some percent.
  TrajectoryRecord before = place_at(0);
  const double parallel = kEarthRadius * std::cos(before.latitude);
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const TrajectoryRecord record = place_at(i);
    const double north = kEarthRadius * (record.latitude - before.latitude);
    const double east = parallel * std::remainder(record.longitude - before.longitude, 2 * std::numbers::pi);
    const double up = record.height - before.height, duration = record.time - before.time;
    const double least = std::max(kLongestJump, kFastestJump * duration);
    if (north * north + east * east + up * up > least * least) {
      return absl::InvalidArgumentError(absl::StrFormat(
          "%s: record %d of %d, at %.3f s, is %.0f m from the one %.3f s before it, farther than an aircraft flies; "
          "leave out the records that jump, or give the parts between them as separate files",
          trajectory.name(), i + 1, trajectory.size(), record.time, std::hypot(north, east, up), duration));
    }
    before = record;
  }
  return absl::OkStatus();
}

std::vector<RecordPair> SpreadPairs(const Trajectory& trajectory, double longest_step) {
  std::vector<RecordPair> pairs;
  const std::size_t last = trajectory.size() - 1;
  const std::size_t count = std::min(kMaxPairs, last);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = i * last / count;
    std::size_t second = first;
    bool whole = true;
    // A margin of half a nanosecond: 20 steps of 0.005 s may add up to a little less than 0.1 s.
    while (whole && second < last && second - first < kMaxSteps &&
           trajectory.TimeAt(second) - trajectory.TimeAt(first) < kStretch - 5e-10) {
      whole = trajectory.TimeAt(second + 1) - trajectory.TimeAt(second) <= longest_step;
      ++second;
    }
    if (whole && second > first) pairs.push_back({first, second});
  }
  return pairs;
}

VelocityPair CompareVelocities(const TrajectoryRecord& first, const TrajectoryRecord& second) {
  const Ellipsoid ellipsoid;
  const double latitude = (first.latitude + second.latitude) / 2;
  const double height = (first.height + second.height) / 2;
  const double duration = second.time - first.time;
  // remainder: a track that crosses the longitude of 180 degrees goes on.
  const double longitude = std::remainder(second.longitude - first.longitude, 2 * std::numbers::pi);
  VelocityPair pair;
  pair.north = (ellipsoid.MeridianRadius(latitude) + height) * (second.latitude - first.latitude) / duration;
  pair.east = (ellipsoid.PrimeVerticalRadius(latitude) + height) * std::cos(latitude) * longitude / duration;
  pair.up = (second.height - first.height) / duration;
  pair.stated_north = (first.velocity_north + second.velocity_north) / 2;
  pair.stated_east = (first.velocity_east + second.velocity_east) / 2;
  pair.stated_up = (first.velocity_up + second.velocity_up) / 2;
  return pair;
}

double VelocityDifference(std::span<const VelocityPair> pairs) {
  std::vector<double> squares;
  squares.reserve(pairs.size());
  for (const VelocityPair& pair : pairs) {
    const double north = pair.north - pair.stated_north;
    const double east = pair.east - pair.stated_east;
    const double up = pair.up - pair.stated_up;
    squares.push_back(north * north + east * east + up * up);
  }
  std::sort(squares.begin(), squares.end());
  const std::size_t kept = squares.size() - squares.size() / 100;
  double sum = 0;
  for (std::size_t i = 0; i < kept; ++i) sum += squares[i];
  return kept == 0 ? 0 : std::sqrt(sum / static_cast<double>(kept));
}

std::optional<double> VelocityDifference(const Trajectory& trajectory) {
  if (!trajectory.states_velocities() || !std::isfinite(trajectory.Record(0).velocity_north)) return std::nullopt;
  std::vector<VelocityPair> pairs;
  for (const RecordPair& pair : SpreadPairs(trajectory))
    pairs.push_back(CompareVelocities(trajectory.Record(pair.first), trajectory.Record(pair.second)));
  if (pairs.empty()) return std::nullopt;
  return VelocityDifference(pairs);
}

}  // namespace albtpu::formats
