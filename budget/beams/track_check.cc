#include "budget/beams/track_check.h"

#include <tbb/parallel_invoke.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <vector>

#include "sea/angle.h"
#include "sea/samples.h"

namespace albtpu {
namespace {

constexpr double kInternationalFoot = 0.3048;  // m, exact. The US survey foot differs by 2e-6, which no height shows.
constexpr double kLargestLeverArm = 10;        // m forward; no survey aircraft mounts a laser farther off.
constexpr double kNearby = 100;                // m; beyond it a displacement is no error of mounting.

std::vector<AirRay> EvenlyThinned(std::span<const AirRay> rays, std::size_t most) {
  const std::vector<AirRay> sorted = ThinRays(rays, {.rays_per_bin = 4, .max_rays = 8 * most});
  const std::size_t stride = (sorted.size() + most - 1) / std::max<std::size_t>(most, 1);
  std::vector<AirRay> kept;
  for (std::size_t i = 0; i < sorted.size(); i += std::max<std::size_t>(stride, 1)) kept.push_back(sorted[i]);
  return kept;
}

// The scatter of the rays themselves: their median angle to a straight track fitted to a few seconds of them. No
// trajectory can be much nearer to the rays.
double AngleAmongRays(std::span<const AirRay> rays) {
  constexpr double kWindow = 3;  // s
  std::vector<double> angles;
  for (std::size_t first = 0, last = 0; first < rays.size(); first = last) {
    while (last < rays.size() && rays[last].time - rays[first].time < kWindow) ++last;
    const auto window = rays.subspan(first, last - first);
    const double time = window[window.size() / 2].time;
    const auto state = WhereRaysMeet(window, time);
    if (!state || window.size() < 12) continue;
    for (const AirRay& ray : window) {
      const Eigen::Vector3d at = state->head<3>() + (ray.time - time) * state->tail<3>();
      angles.push_back(AngleBetween((ray.water_point - at).normalized(), ray.direction, 0).norm());
    }
  }
  return angles.empty() ? 0.1 : Median(std::move(angles));
}

Correction CorrectionOf(const DisplacementFit& fit, Eigen::Index parameter, double before = 0) {
  return {before + fit.values[parameter], fit.sigmas[parameter], fit.freedom};
}

// The time offset under which the track meets the rays best: a scan in steps of half a second, of which some 30 m of
// flight pass, then Gauss-Newton from the best three.
struct TimeSearch {
  Correction offset;
  double angle = std::numeric_limits<double>::infinity();
};

TimeSearch FindTimeOffset(std::span<const AirRay> rays, const TrackPositions& track, const TrackCheckOptions& options) {
  constexpr double kStep = 0.5;
  constexpr std::size_t kScanned = 1000;
  std::vector<AirRay> few;
  for (std::size_t i = 0; i < rays.size(); i += rays.size() / kScanned + 1) few.push_back(rays[i]);
  std::vector<std::pair<double, double>> scan;  // Median angle, offset.
  const int steps = static_cast<int>(options.longest_time_offset / kStep);
  for (int i = -steps; i <= steps; ++i) {
    const std::vector<TrackedRay> tracked = FollowTrack(few, track, i * kStep);
    if (2 * tracked.size() >= few.size()) scan.emplace_back(MedianAngle(tracked), i * kStep);
  }
  std::sort(scan.begin(), scan.end());
  TimeSearch best;
  for (std::size_t i = 0; i < std::min<std::size_t>(scan.size(), 3); ++i) {
    double offset = scan[i].second;
    for (int round = 0; round < 3; ++round) {
      const std::vector<TrackedRay> tracked = FollowTrack(rays, track, offset);
      if (tracked.size() < options.min_rays) break;
      const DisplacementFit fit = FitDisplacement(tracked, Displacement::kTime, options.index);
      if (fit.median_angle < best.angle) best = {CorrectionOf(fit, 0, offset), fit.median_angle};
      offset += std::clamp(fit.values[0], -2.0, 2.0);
    }
  }
  return best;
}

// The largest error of a correction that chance makes as rarely as `significance` standard errors of a normal error. A
// sigma of few degrees of freedom is itself uncertain, and Student's distribution has wide tails.
double ReachOf(const Correction& correction, const TrackCheckOptions& options) {
  return correction.sigma / WidthOfStudent(correction.freedom) *
         StudentQuantile(correction.freedom, std::erfc(options.significance / std::numbers::sqrt2) / 2);
}

bool Significant(const Correction& correction, const TrackCheckOptions& options) {
  return std::abs(correction.value) > ReachOf(correction, options);
}

// The mean difference of incidence, the rms, and what belongs to them.
void CompareIncidence(std::span<const TrackedRay> tracked, const DisplacementFit& fit, TrackCheck& check) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const TrackedRay& ray : tracked) centre += ray.position / static_cast<double>(tracked.size());
  std::vector<double> times, differences, weights, incidences, ranges, distances;
  double squares = 0, sum = 0;
  for (const TrackedRay& ray : tracked) {
    const Eigen::Vector3d to = ray.ray.water_point - ray.position;
    const Eigen::Vector3d& u = ray.ray.direction;
    const Eigen::Vector3d displaced = to - DisplacementOf(ray, Displacement::kOffset, fit.values, centre);
    const Eigen::Vector3d v = to.normalized();
    const double sine = v.head<2>().norm();
    // Outward in the vertical plane of v. The component of the angle in it is the difference of incidence, but it has
    // no kink at nadir, where the incidence of every erroneous ray is too great.
    const Eigen::Vector3d outward = sine > 0 ? Eigen::Vector3d(-v.z() * v.x() / sine, -v.z() * v.y() / sine, sine)
                                             : Eigen::Vector3d::UnitX().eval();
    const double square = AngleBetween(displaced.normalized(), u, fit.flattening).squaredNorm();
    times.push_back(ray.ray.time);
    differences.push_back(-AngleBetween(v, u, fit.flattening).dot(outward));
    weights.push_back(WeightOf(fit.noise, ray.ray.separation, square).good);
    incidences.push_back(std::atan2(sine, -v.z()));
    ranges.push_back(displaced.norm());
    distances.push_back(to.cross(u).norm());
    squares += weights.back() * differences.back() * differences.back();
    sum += weights.back();
  }
  const MeanOverTime mean = WeightedMean(times, differences, weights);
  check.mean_difference = {mean.mean, mean.sigma, mean.freedom};
  check.rms_difference = std::sqrt(squares / sum);
  check.median_incidence = Median(std::move(incidences));
  check.range = Median(std::move(ranges));
  check.distance = Median(std::move(distances));
}

// rad, of the rays themselves. At most 1.2, 69 degrees, beyond any scanner: there the limits below would lose meaning,
// as an offset across the beam turns it by its cosine.
double MedianIncidence(const std::vector<AirRay>& rays) {
  std::vector<double> incidences;
  for (const AirRay& ray : rays) incidences.push_back(std::acos(std::clamp(-ray.direction.z(), 0.0, 1.0)));
  return std::min(Median(std::move(incidences)), 1.2);
}

}  // namespace

bool Disagrees(TrackVerdict verdict) {
  return verdict != TrackVerdict::kAgrees && verdict != TrackVerdict::kTooFewRays;
}

TrackCheck CheckTrack(std::span<const AirRay> rays, const TrackPositions& track, const TrackCheckOptions& options) {
  TrackCheck check;
  const std::vector<AirRay> kept = EvenlyThinned(rays, options.max_rays);
  const std::vector<TrackedRay> tracked = FollowTrack(kept, track, 0);
  check.rays = tracked.size();
  if (tracked.size() < std::max<std::size_t>(options.min_rays, 8)) return check;

  DisplacementFit offset, turned;
  double among = 0;
  tbb::parallel_invoke([&] { offset = FitDisplacement(tracked, Displacement::kOffset, options.index); },
                       [&] { turned = FitDisplacement(tracked, Displacement::kOffsetRotation, options.index); },
                       [&] { among = AngleAmongRays(kept); });
  check.forward = CorrectionOf(offset, 0);
  check.right = CorrectionOf(offset, 1);
  check.up = CorrectionOf(offset, 2);
  check.angle_with_offset = offset.median_angle;
  check.median_angle = MedianAngle(tracked);
  CompareIncidence(tracked, offset, check);

  // The change of the median incidence with each component of the offset.
  const double incidence = MedianIncidence(kept);
  const double per_across = std::cos(incidence) / check.range, per_up = std::sin(incidence) / check.range;
  const auto matters = [&](const Correction& c, double per) {
    return Significant(c, options) && std::abs(c.value) * per > options.limit;
  };
  constexpr double kFar = 0.01;  // rad; what curved flight adds to the deviation from straight windows.
  const bool far = check.median_angle > 2 * among + kFar;
  const bool across = matters(check.forward, per_across) || matters(check.right, per_across);
  const bool up = matters(check.up, per_up);

  // A rotation moves the ends of lines; its effect is that at the root mean square distance from the middle.
  check.rotation = CorrectionOf(turned, 3);
  check.angle_with_rotation = turned.median_angle;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const TrackedRay& ray : tracked) centre += ray.position / static_cast<double>(tracked.size());
  double spread = 0, heights = 0;
  for (const TrackedRay& ray : tracked) {
    spread += (ray.position - centre).head<2>().squaredNorm() / static_cast<double>(tracked.size());
    heights += ray.position.z() / static_cast<double>(tracked.size());
  }
  const bool rotates = matters(check.rotation, std::sqrt(spread) * per_across);
  check.height_ratio = 1 + check.up.value / heights;

  if (!far && !across && !up && !rotates && !matters(check.mean_difference, 1)) {
    const bool known = ReachOf(check.mean_difference, options) < RadiansOfDegrees(1);
    check.verdict = known ? TrackVerdict::kAgrees : TrackVerdict::kTooFewRays;
    return check;
  }

  // The cause: the simplest displacement after which the rays agree about as well as after any.
  double speed = 0;
  for (const TrackedRay& ray : tracked) speed += ray.velocity.norm() / static_cast<double>(tracked.size());
  const TimeSearch search = FindTimeOffset(kept, track, options);
  check.time = search.offset;
  check.angle_with_time = search.angle;
  double beside_time = std::numeric_limits<double>::infinity();
  double angle_with_both = std::numeric_limits<double>::infinity();
  if (std::isfinite(search.angle)) {
    const std::vector<TrackedRay> shifted = FollowTrack(kept, track, search.offset.value);
    if (shifted.size() >= options.min_rays) {
      const DisplacementFit rest = FitDisplacement(shifted, Displacement::kOffset, options.index);
      check.up_with_time = rest.values[2];
      beside_time = rest.values.head<2>().norm();
      angle_with_both = rest.median_angle;
    }
  }
  const double best = std::min({check.angle_with_offset, check.angle_with_rotation, angle_with_both});
  const auto explains = [&](double angle) { return angle <= 1.15 * best + RadiansOfDegrees(0.02); };
  const double moved = std::abs(search.offset.value) * speed;
  const double horizontal = std::hypot(check.forward.value, check.right.value);
  const double inverse = 1 / kInternationalFoot;
  const auto near_ratio = [&](double ratio) { return std::abs(check.height_ratio / ratio - 1) < 0.08; };

  // A correct track, once displaced, is as near to the rays as the rays are to each other. The tracks of single windows
  // have 6 parameters for as few as 12 rays of two components each, so they are too near by sqrt(24 / 18) = 1.15.
  const bool unexplained = best > 1.3 * among + RadiansOfDegrees(0.1);
  if (!unexplained && moved > kLargestLeverArm && Significant(check.time, options) && explains(angle_with_both) &&
      beside_time < std::max(kLargestLeverArm, 0.02 * moved))
    check.verdict = TrackVerdict::kTimeOffset;
  else if (unexplained || (explains(check.angle_with_offset) && horizontal > kNearby))
    check.verdict = TrackVerdict::kUnrelated;
  else if (rotates && !explains(check.angle_with_offset))
    check.verdict = TrackVerdict::kRotation;
  else if (std::abs(check.up.value) > kNearby / 2 && (near_ratio(kInternationalFoot) || near_ratio(inverse)))
    check.verdict = TrackVerdict::kHeightUnit;
  else if (std::abs(check.up.value) * per_up > horizontal * per_across)
    check.verdict = TrackVerdict::kHeightOffset;
  else
    check.verdict = TrackVerdict::kHorizontalOffset;
  return check;
}

std::string Describe(const TrackCheck& check) {
  char text[400];
  const auto print = [&](const char* format, auto... values) {
    std::snprintf(text, sizeof text, format, values...);
    return std::string(text);
  };
  const double mean = DegreesOfRadians(check.mean_difference.value);
  switch (check.verdict) {
    case TrackVerdict::kAgrees:
      return print(
          "the returns agree with the trajectory: incidence differs by %.3f +- %.3f degrees in the mean of "
          "%zu rays",
          mean, DegreesOfRadians(check.mean_difference.sigma), check.rays);
    case TrackVerdict::kTooFewRays:
      return print("%zu pairs of returns below the water are too few to check the trajectory", check.rays);
    case TrackVerdict::kTimeOffset: {
      const double leap = std::round(check.time.value);
      const bool is_leap = std::abs(check.time.value - leap) < 0.3 && std::abs(leap) >= 16 && std::abs(leap) <= 18;
      const std::string why = !is_leap   ? ""
                              : leap < 0 ? " (GPS - UTC: the trajectory is in UTC, the points in GPS time)"
                                         : " (GPS - UTC: the points are in UTC, the trajectory in GPS time)";
      std::string result = print("the times of the trajectory are %.2f s %s those of the points",
                                 std::abs(check.time.value), check.time.value < 0 ? "behind" : "ahead of");
      result += why;
      if (std::abs(check.up_with_time) > kLargestLeverArm)
        result += print(", and its heights are %.1f m too %s", std::abs(check.up_with_time),
                        check.up_with_time < 0 ? "high" : "low");
      return result;
    }
    case TrackVerdict::kHeightOffset:
      return print(
          "the trajectory is %.1f +- %.1f m too %s (a geoid separation, a datum or the vertical part of a "
          "lever arm is missing)",
          std::abs(check.up.value), check.up.sigma, check.up.value < 0 ? "high" : "low");
    case TrackVerdict::kHeightUnit:
      return print("the heights of the trajectory are %.4f times the true ones (%s)", 1 / check.height_ratio,
                   check.height_ratio < 1 ? "they are in feet, not in metres" : "metres were taken for feet");
    case TrackVerdict::kHorizontalOffset:
      return print("the sensor was %.1f +- %.1f m forward and %.1f +- %.1f m to the right of the trajectory (%s)",
                   check.forward.value, check.forward.sigma, check.right.value, check.right.sigma,
                   std::hypot(check.forward.value, check.right.value) > kLargestLeverArm
                       ? "a datum, a coordinate system or another flight"
                       : "a lever arm, its sign or its axes, or times that are a fraction of a second off");
    case TrackVerdict::kRotation:
      return print(
          "the trajectory is rotated by %.2f degrees to the %s (a meridian convergence, a coordinate system "
          "or another flight)",
          std::abs(DegreesOfRadians(check.rotation.value)), check.rotation.value < 0 ? "left" : "right");
    case TrackVerdict::kUnrelated:
      return print(
          "the rays do not meet at the trajectory: it passes them at %.0f m in the median (another flight, "
          "another zone or another datum)",
          check.distance);
  }
  return "";
}

}  // namespace albtpu
