#include "formats/trajectories/velocity_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "formats/crs/ellipsoid.h"

namespace albtpu::formats {
namespace {

constexpr std::size_t kMaxPairs = 4096;
constexpr double kStretch = 0.1;         // s
constexpr std::size_t kMaxSteps = 1000;  // In a stretch: disorder costs no more time than order.

}  // namespace

std::vector<RecordPair> SpreadPairs(const Trajectory& trajectory) {
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
      whole = trajectory.TimeAt(second + 1) - trajectory.TimeAt(second) <= kLongestStep;
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
  if (!std::isfinite(trajectory.Record(0).velocity_north)) return std::nullopt;
  std::vector<VelocityPair> pairs;
  for (const RecordPair& pair : SpreadPairs(trajectory)) {
    pairs.push_back(CompareVelocities(trajectory.Record(pair.first), trajectory.Record(pair.second)));
  }
  if (pairs.empty()) return std::nullopt;
  return VelocityDifference(pairs);
}

}  // namespace albtpu::formats
