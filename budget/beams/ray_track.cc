#include "budget/beams/ray_track.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace albtpu {
namespace {

// Parts of a knot interval in the table of standard deviations, which vary smoothly over an interval.
constexpr double kParts = 8;

double RmsIncidenceSigma(const Eigen::Matrix3d& covariance, double height, double incidence) {
  const double range = height / std::cos(incidence);
  const double across = std::cos(incidence) / range, up = std::sin(incidence) / range;
  return std::sqrt(across * across * (covariance(0, 0) + covariance(1, 1)) / 2 + up * up * covariance(2, 2));
}

}  // namespace

RayTrack::RayTrack(std::vector<RaySegment> segments, const RayTrackOptions& options)
    : segments_(std::move(segments)), options_(options) {
  for (const RaySegment& segment : segments_) {
    SigmaTable& table = tables_.emplace_back();
    const auto parts = static_cast<std::size_t>(kParts) * (segment.times.count - 1);
    for (std::size_t i = 0; i <= parts; ++i) {
      const double time = segment.times.start + segment.times.step * static_cast<double>(i) / kParts;
      const TrackEstimate at = EstimateAt(segment, time);
      const bool aircraft = at.height >= options_.min_height && at.height <= options_.max_height &&
                            at.velocity.norm() < options_.max_speed;
      table.sigma.push_back(aircraft ? at.incidence_sigma : std::numeric_limits<double>::infinity());
    }
  }
}

const RaySegment* RayTrack::Find(double time) const {
  const auto next = std::upper_bound(segments_.begin(), segments_.end(), time,
                                     [](double t, const RaySegment& segment) { return t < segment.start; });
  if (next == segments_.begin()) return nullptr;
  const RaySegment& segment = *(next - 1);
  return time <= segment.end ? &segment : nullptr;
}

TrackEstimate RayTrack::EstimateAt(const RaySegment& segment, double time) const {
  const KnotPlace place = segment.times.Find(time);
  const KnotState& a = segment.knots.states[place.first];
  const KnotState& b = segment.knots.states[place.first + 1];
  const auto mix = [&](const std::array<double, 4>& w) -> Eigen::Vector3d {
    return w[0] * a.head<3>() + w[1] * a.tail<3>() + w[2] * b.head<3>() + w[3] * b.tail<3>();
  };
  TrackEstimate at{.position = mix(place.position),
                   .velocity = mix(place.rate),
                   .covariance = segment.knots.PositionCovariance(place)};
  at.covariance.diagonal().array() += segment.times.BridgeVariance(place.fraction, segment.acceleration);
  at.height = at.position.z() - segment.water_height;
  at.incidence_sigma = RmsIncidenceSigma(at.covariance, std::abs(at.height), segment.median_incidence);
  return at;
}

std::optional<TrackEstimate> RayTrack::At(double time) const {
  const RaySegment* segment = Find(time);
  if (segment == nullptr) return std::nullopt;
  return EstimateAt(*segment, time);
}

void RayTrack::PositionsAt(std::span<const double> times, std::span<SensorPosition> positions,
                           std::span<TrackOutcome> outcomes) const {
  const RaySegment* segment = nullptr;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double time = times[i];
    if (segment == nullptr || !(time >= segment->start && time <= segment->end)) segment = Find(time);
    if (segment == nullptr) {
      outcomes[i] = TrackOutcome::kOutside;
      continue;
    }
    const KnotPlace place = segment->times.Find(time);
    const KnotState& a = segment->knots.states[place.first];
    const KnotState& b = segment->knots.states[place.first + 1];
    const auto& w = place.position;
    const Eigen::Vector3d x = w[0] * a.head<3>() + w[1] * a.tail<3>() + w[2] * b.head<3>() + w[3] * b.tail<3>();
    const std::vector<double>& sigma = tables_[static_cast<std::size_t>(segment - segments_.data())].sigma;
    const double part = kParts * (static_cast<double>(place.first) + place.fraction);
    const std::size_t before = std::min(static_cast<std::size_t>(part), sigma.size() - 2);
    const double rest = part - static_cast<double>(before);
    const double incidence_sigma = rest > 0 ? (1 - rest) * sigma[before] + rest * sigma[before + 1] : sigma[before];
    positions[i] = {.x = x.x(), .y = x.y(), .z = x.z(), .incidence_sigma = incidence_sigma};
    outcomes[i] = incidence_sigma <= options_.largest_incidence_sigma ? TrackOutcome::kKnown : TrackOutcome::kUncertain;
  }
}

RayTrack FitTrack(std::span<const AirRay> rays, const RayTrackOptions& options) {
  const std::vector<AirRay> kept = ThinRays(rays, options.thinning);
  std::vector<RaySegment> segments;
  for (std::size_t first = 0, last = 0; first < kept.size(); first = last) {
    last = first + 1;
    while (last < kept.size() && kept[last].time - kept[last - 1].time <= options.longest_gap) ++last;
    if (auto segment = FitSegment(std::span(kept).subspan(first, last - first), options))
      segments.push_back(*std::move(segment));
  }
  return RayTrack(std::move(segments), options);
}

}  // namespace albtpu
