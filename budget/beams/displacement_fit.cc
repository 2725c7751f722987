#include "budget/beams/displacement_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "sea/response/closed_form.h"
#include "sea/samples.h"

namespace albtpu {
namespace {

using Derivative = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 4>;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;
using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1>;

constexpr double kCorrelation = 0.5;  // s, as in the fit of a track.
constexpr double kScoreCell = 0.05;   // s
// rad, of rays by waves: slopes of 0.6 along each axis, which break. Rays that scatter more do not belong to the track.
constexpr double kSteepest = 0.2;

int Parameters(Displacement displacement) {
  return displacement == Displacement::kTime ? 1 : displacement == Displacement::kOffset ? 3 : 4;
}

// Forward, right and up of a velocity; a sensor that stands still looks north.
Eigen::Matrix3d Axes(const Eigen::Vector3d& velocity) {
  const double speed = velocity.head<2>().norm();
  const Eigen::Vector2d forward =
      speed > 0 ? Eigen::Vector2d(velocity.head<2>() / speed) : Eigen::Vector2d::UnitY().eval();
  Eigen::Matrix3d axes;
  axes << forward.x(), forward.y(), 0, forward.y(), -forward.x(), 0, 0, 0, 1;
  return axes;
}

Derivative DerivativeOf(const TrackedRay& ray, Displacement displacement, const Eigen::Vector3d& centre) {
  Derivative d(3, Parameters(displacement));
  if (displacement == Displacement::kTime) {
    d = ray.velocity;
    return d;
  }
  d.leftCols<3>() = Axes(ray.velocity);
  if (displacement == Displacement::kOffsetRotation) d.col(3) = Eigen::Vector3d::UnitZ().cross(ray.position - centre);
  return d;
}

// The covariance of the sum of scores that are correlated for up to kCorrelation: sums over cells of kScoreCell, and
// their products at all lags with Bartlett's weights, widened by WidthOfStudent. Its degrees of freedom are the number
// of correlation times, less the fitted parameters.
struct LongRun {
  Square covariance;
  int freedom;
};

template <typename Score>
LongRun LongRunCovariance(std::span<const double> times, int size, const Score& score) {
  const auto lags = static_cast<std::int64_t>(kCorrelation / kScoreCell);
  std::vector<std::pair<std::int64_t, Column>> cells;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto cell = static_cast<std::int64_t>(std::floor((times[i] - times[0]) / kScoreCell));
    if (cells.empty() || cells.back().first != cell) cells.emplace_back(cell, Column::Zero(size));
    cells.back().second += score(i);
  }
  Square sum = Square::Zero(size, size);
  int correlation_times = 0;
  std::int64_t counted = std::numeric_limits<std::int64_t>::min() / 2;
  for (std::size_t a = 0; a < cells.size(); ++a) {
    if (cells[a].first - counted > lags) ++correlation_times, counted = cells[a].first;
    sum += cells[a].second * cells[a].second.transpose();
    for (std::size_t b = a + 1; b < cells.size() && cells[b].first - cells[a].first <= lags; ++b) {
      const double bartlett = 1 - static_cast<double>(cells[b].first - cells[a].first) / static_cast<double>(lags + 1);
      const Square product = bartlett * cells[a].second * cells[b].second.transpose();
      sum += product + product.transpose();
    }
  }
  const int freedom = std::max(1, correlation_times - size);
  return {sum * std::pow(WidthOfStudent(freedom), 2), freedom};
}

}  // namespace

std::vector<TrackedRay> FollowTrack(std::span<const AirRay> rays, const TrackPositions& track, double shift) {
  constexpr double kHalf = 0.25;  // s, of the difference that gives the velocity; shorter than any swing.
  std::vector<double> times(3 * rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i)
    for (int j = 0; j < 3; ++j)
      times[static_cast<std::size_t>(j) * rays.size() + i] = rays[i].time + shift + (j - 1) * kHalf;
  std::vector<Eigen::Vector3d> positions(times.size(), Eigen::Vector3d::Constant(std::nan("")));
  track(times, positions);
  std::vector<TrackedRay> tracked;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Vector3d& at = positions[rays.size() + i];
    if (!at.allFinite()) continue;
    const bool has_before = positions[i].allFinite(), has_after = positions[2 * rays.size() + i].allFinite();
    if (!has_before && !has_after) continue;
    const Eigen::Vector3d& before = has_before ? positions[i] : at;
    const Eigen::Vector3d& after = has_after ? positions[2 * rays.size() + i] : at;
    tracked.push_back({rays[i], at, (after - before) / (kHalf * (has_before + has_after))});
  }
  return tracked;
}

Eigen::Vector3d DisplacementOf(const TrackedRay& ray, Displacement displacement, const Eigen::VectorXd& values,
                               const Eigen::Vector3d& centre) {
  return DerivativeOf(ray, displacement, centre) * values;
}

double MedianAngle(std::span<const TrackedRay> rays) {
  std::vector<double> angles;
  for (const TrackedRay& ray : rays)
    angles.push_back(AngleBetween((ray.ray.water_point - ray.position).normalized(), ray.ray.direction, 0).norm());
  return Median(std::move(angles));
}

MeanOverTime WeightedMean(std::span<const double> times, std::span<const double> values,
                          std::span<const double> weights) {
  double sum = 0, weight = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += weights[i] * values[i], weight += weights[i];
  const double mean = sum / weight;
  const auto [variance, freedom] =
      LongRunCovariance(times, 1, [&](std::size_t i) { return Column::Constant(1, weights[i] * (values[i] - mean)); });
  return {mean, std::sqrt(variance(0, 0)) / weight, freedom};
}

DisplacementFit FitDisplacement(std::span<const TrackedRay> rays, Displacement displacement, double index) {
  constexpr int kDistanceRounds = 9, kAngleRounds = 15, kFlattenedFrom = 2;
  constexpr double kSmallStep = 1e-6;  // Of a standard error.
  const int size = Parameters(displacement);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const TrackedRay& ray : rays) centre += ray.position / static_cast<double>(rays.size());

  std::vector<double> times(rays.size()), squares(rays.size()), separations(rays.size()), incidences;
  std::vector<Derivative> derivatives;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    derivatives.push_back(DerivativeOf(rays[i], displacement, centre));
    times[i] = rays[i].ray.time;
    separations[i] = rays[i].ray.separation;
    incidences.push_back(std::atan2(rays[i].ray.direction.head<2>().norm(), -rays[i].ray.direction.z()));
  }
  const double incidence = std::clamp(Median(std::move(incidences)), 0.01, 1.2);
  const FacingSlopes facing = FacingSlopesAt(incidence, index);

  DisplacementFit fit;
  // Start: distances from the lines of the rays, which are linear in the parameters.
  Column values = Column::Zero(size);
  std::vector<double> weights(rays.size(), 1), distances(rays.size());
  for (int round = 0; round < kDistanceRounds; ++round) {
    Square normal = Square::Zero(size, size);
    Column right = Column::Zero(size);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto& [ray, position, velocity] = rays[i];
      const Derivative& d = derivatives[i];
      const Eigen::Vector3d gap = ray.water_point - position;
      const Derivative across = d - ray.direction * (ray.direction.transpose() * d);
      normal += weights[i] * across.transpose() * d;
      right += weights[i] * across.transpose() * gap;
    }
    values = normal.ldlt().solve(right);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Eigen::Vector3d at = rays[i].position + derivatives[i] * values - rays[i].ray.water_point;
      distances[i] = at.cross(rays[i].ray.direction).norm();
    }
    const double scale = std::max(Median(distances), 1e-6);
    for (std::size_t i = 0; i < rays.size(); ++i) weights[i] = 1 / (1 + distances[i] * distances[i] / (scale * scale));
  }

  // Then angles.
  std::vector<Eigen::Vector3d> residuals(rays.size()), directions(rays.size());
  std::vector<double> ranges(rays.size());
  const auto look = [&] {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Eigen::Vector3d to = rays[i].ray.water_point - rays[i].position - derivatives[i] * values;
      ranges[i] = std::max(to.norm(), 1.0);
      directions[i] = to.normalized();
      residuals[i] = AngleBetween(directions[i], rays[i].ray.direction, fit.flattening);
      squares[i] = residuals[i].squaredNorm();
    }
  };
  Square normal;
  double response = 0, weight = 0;
  std::vector<Column> scores(rays.size());
  const auto assemble = [&] {
    normal = Square::Zero(size, size);
    response = weight = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const RayWeight w = WeightOf(fit.noise, separations[i], squares[i]);
      const Derivative& d = derivatives[i];
      const Derivative across = d - directions[i] * (directions[i].transpose() * d);
      normal += w.weight / (ranges[i] * ranges[i]) * across.transpose() * d;
      scores[i] = -w.weight / ranges[i] * (across.transpose() * residuals[i]);
      weight += w.weight;
      response += w.response;
    }
  };
  look();
  fit.noise = RobustRayNoise(squares, separations);
  for (int round = 0; round < kAngleRounds; ++round) {
    fit.noise = FitRayNoise(squares, separations, fit.noise, round == 0 ? 10 : 3);
    if (round >= kFlattenedFrom)
      fit.flattening =
          std::pow(std::min(fit.noise.slopes, kSteepest) / facing.gain, 2) * facing.bias / std::sin(incidence);
    assemble();
    Column right = Column::Zero(size);
    for (const Column& score : scores) right += score;
    const Column step = normal.ldlt().solve(right);
    values += step;
    look();
    if (round > kFlattenedFrom && step.dot(normal * step) < kSmallStep * kSmallStep) break;
  }
  assemble();
  const double curvature = std::clamp(response / weight, 0.3, 1.0);
  const Square inverse = normal.ldlt().solve(Square::Identity(size, size));
  const LongRun of_scores = LongRunCovariance(times, size, [&](std::size_t i) { return scores[i]; });
  const Square covariance = inverse * of_scores.covariance * inverse;
  fit.values = values;
  fit.freedom = of_scores.freedom;
  fit.sigmas = covariance.diagonal().cwiseMax(0).cwiseSqrt() / curvature;
  for (double& square : squares) square = std::sqrt(square);
  fit.median_angle = Median(squares);
  return fit;
}

namespace {

// The angles, in the plane of incidence and across it, between the beam at `incidence` towards +x and the ray in air
// that follows from its path behind a facet of slope `slope`.
Eigen::Vector2d AngleBehind(double incidence, double index, const Eigen::Vector2d& slope) {
  const Eigen::Vector3d beam(std::sin(incidence), 0, -std::cos(incidence));
  const RefractedRay refracted = RefractAtSlope(beam, slope, index);
  const Eigen::Vector2d in_air = index * refracted.tangent / refracted.secant;
  const Eigen::Vector3d ray(in_air.x(), in_air.y(), -std::sqrt(1 - in_air.squaredNorm()));
  const Eigen::Vector3d outward(std::cos(incidence), 0, std::sin(incidence));
  const Eigen::Vector2d across(ray.dot(outward), ray.y());
  return across.norm() > 0 ? across * (std::atan2(across.norm(), ray.dot(beam)) / across.norm()) : across;
}

}  // namespace

// By central differences, whose error is some 1e-6 of the result.
FacingSlopes FacingSlopesAt(double incidence, double index) {
  constexpr double kStep = 1e-3;
  const auto f = [&](double x, double y) { return AngleBehind(incidence, index, Eigen::Vector2d(x, y) * kStep); };
  const double along = (f(1, 0).x() - f(-1, 0).x()) / (2 * kStep);
  const double across = (f(0, 1).y() - f(0, -1).y()) / (2 * kStep);
  const double laplacian =
      (f(1, 0).x() + f(-1, 0).x() + f(0, 1).x() + f(0, -1).x() - 4 * f(0, 0).x()) / (kStep * kStep);
  return {.gain = std::sqrt((along * along + across * across) / 2),
          .bias = std::tan(incidence) * along + laplacian / 2};
}

}  // namespace albtpu
