#include "budget/beams/return_pair.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <tbb/parallel_sort.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "sea/samples.h"

namespace albtpu {
namespace {

// Lower bound of the errors of directions: 1 mm of a return over a separation of 10 m, or slopes of 1e-4.
constexpr double kMinSigma = 2e-5;
// Outliers must deviate more than good rays, or the fit could not separate the two.
constexpr double kMinOutlierRatio = 4;

// Sums over rays of what the maximization step needs. The good rays' part is a regression of |r|^2 / 2 on
// 1 and 1 / separation^2, weighted by p / sigma^4.
struct Sums {
  double s0 = 0, s1 = 0, s2 = 0, y0 = 0, y1 = 0;
  double good = 0, bad = 0, bad_squares = 0, variance = 0;
  Sums& operator+=(const Sums& o) {
    s0 += o.s0, s1 += o.s1, s2 += o.s2, y0 += o.y0, y1 += o.y1;
    good += o.good, bad += o.bad, bad_squares += o.bad_squares, variance += o.variance;
    return *this;
  }
};

// The regression with both coefficients at least 0.
void SolveVariances(const Sums& s, RayNoise& noise) {
  const double determinant = s.s0 * s.s2 - s.s1 * s.s1;
  double slopes = -1, points = -1;
  if (determinant > 1e-9 * s.s0 * s.s2) {
    slopes = (s.s2 * s.y0 - s.s1 * s.y1) / determinant;
    points = (s.s0 * s.y1 - s.s1 * s.y0) / determinant;
  }
  if (slopes < 0 || points < 0) {
    // On one of the borders, the one that explains more of the squares.
    const double only_slopes = s.y0 / s.s0, only_points = s.y1 / s.s2;
    const bool by_slopes = s.y0 * only_slopes >= s.y1 * only_points;
    slopes = by_slopes ? only_slopes : 0;
    points = by_slopes ? 0 : only_points;
  }
  noise.slopes = std::max(std::sqrt(slopes), kMinSigma);
  noise.points = std::sqrt(points);
}

// Weights of many rays by one noise. Reciprocals are computed once: they take longer than all else but the exponential.
class Weights {
 public:
  explicit Weights(const RayNoise& noise)
      : slopes_(noise.slopes * noise.slopes),
        points_(noise.points * noise.points),
        outliers_(1 / (noise.outlier_sigma * noise.outlier_sigma)),
        odds_(noise.outlier_share / (1 - noise.outlier_share)) {}

  struct Of {
    RayWeight weight;
    double variance, precision;  // Of a good ray, and its inverse.
  };
  // `x`: 1 / separation^2.
  Of operator()(double x, double square) const {
    const double variance = slopes_ + points_ * x, precision = 1 / variance;
    const double bad = std::min(outliers_, precision / (kMinOutlierRatio * kMinOutlierRatio));
    const double difference = precision - bad;
    // The odds of an outlier: the ratio of the two densities times that of the fractions.
    const double odds = odds_ * variance * bad * std::exp(std::min(square * difference / 2, 700.0));
    const double good = 1 / (1 + odds), weight = good * difference + bad;
    const double response = weight - square / 2 * good * (1 - good) * difference * difference;
    return {{.good = good, .weight = weight, .response = response}, variance, precision};
  }

 private:
  double slopes_, points_, outliers_, odds_;
};

}  // namespace

RayWeight WeightOf(const RayNoise& noise, double separation, double square) {
  return Weights(noise)(1 / (separation * separation), square).weight;
}

RayNoise FitRayNoise(std::span<const double> squares, std::span<const double> separations, const RayNoise& start,
                     int steps) {
  RayNoise noise = start;
  for (int step = 0; step < steps; ++step) {
    const Weights weights(noise);
    const Sums sums = tbb::parallel_deterministic_reduce(
        tbb::blocked_range<std::size_t>(0, squares.size(), 16384), Sums{},
        [&](const tbb::blocked_range<std::size_t>& range, Sums s) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const double x = 1 / (separations[i] * separations[i]);
            const auto [weight, variance, precision] = weights(x, squares[i]);
            const double good = weight.good;
            const double w = good * precision * precision;
            s += Sums{.s0 = w,
                      .s1 = w * x,
                      .s2 = w * x * x,
                      .y0 = w * squares[i] / 2,
                      .y1 = w * x * squares[i] / 2,
                      .good = good,
                      .bad = 1 - good,
                      .bad_squares = (1 - good) * squares[i],
                      .variance = good * variance};
          }
          return s;
        },
        [](Sums a, const Sums& b) { return a += b; });
    if (!(sums.good > 0)) break;
    SolveVariances(sums, noise);
    // One pseudo-observation of each kind keeps the fraction away from 0 and 1.
    noise.outlier_share = std::clamp((sums.bad + 0.5) / (sums.good + sums.bad + 1), 1e-4, 0.6);
    const double least = kMinOutlierRatio * std::sqrt(sums.variance / sums.good);
    const double prior = 0.09;  // rad^2: 0.3 rad, one observation.
    noise.outlier_sigma = std::max(std::sqrt((sums.bad_squares / 2 + prior) / (sums.bad + 1)), least);
  }
  return noise;
}

RayNoise RobustRayNoise(std::span<const double> squares, std::span<const double> separations) {
  // |r|^2 of two normal components has the median 2 ln 2 sigma^2. Half of the variance goes to each cause.
  const double variance = std::max(Median({squares.begin(), squares.end()}) / 1.386, kMinSigma * kMinSigma);
  const double separation = Median({separations.begin(), separations.end()});
  const double sigma = std::sqrt(variance / 2);
  return {.slopes = sigma,
          .points = sigma * separation,
          .outlier_share = 0.1,
          .outlier_sigma = std::max(0.3, kMinOutlierRatio * std::sqrt(variance))};
}

std::optional<AirRay> RayOfPair(const ReturnPair& pair, double water_height, double index, double min_separation) {
  if (!(pair.upper.z() < water_height) || !(pair.lower.z() < pair.upper.z())) return std::nullopt;
  const Eigen::Vector3d between = pair.lower - pair.upper;
  const double separation = between.norm();
  if (!(separation >= min_separation)) return std::nullopt;
  const Eigen::Vector3d in_water = between / separation;
  const Eigen::Vector2d in_air = index * in_water.head<2>();
  const double cosine_squared = 1 - in_air.squaredNorm();
  if (!(cosine_squared > 0) || !std::isfinite(pair.time)) return std::nullopt;
  const double up = (water_height - pair.upper.z()) / -in_water.z();
  return AirRay{.time = pair.time,
                .water_point = pair.upper - up * in_water,
                .direction = Eigen::Vector3d(in_air.x(), in_air.y(), -std::sqrt(cosine_squared)),
                .separation = separation};
}

namespace {

// More rays do not make a better start.
constexpr std::size_t kMaxRays = 600;
constexpr std::size_t kMinRays = 6;

}  // namespace

std::optional<KnotState> WhereRaysMeet(std::span<const AirRay> rays, double time) {
  if (rays.size() < kMinRays) return std::nullopt;
  const std::size_t stride = (rays.size() + kMaxRays - 1) / kMaxRays;
  const std::size_t count = (rays.size() + stride - 1) / stride;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < count; ++i) centre += rays[i * stride].water_point / static_cast<double>(count);

  std::vector<double> weights(count, 1), distances(count);
  KnotState state = KnotState::Zero();
  for (int round = 0; round <= 8; ++round) {
    KnotMatrix normal = KnotMatrix::Zero();
    KnotState right = KnotState::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      const AirRay& ray = rays[i * stride];
      const double dt = ray.time - time;
      const Eigen::Matrix3d q = weights[i] * (Eigen::Matrix3d::Identity() - ray.direction * ray.direction.transpose());
      const Eigen::Vector3d qs = q * (ray.water_point - centre);
      normal.topLeftCorner<3, 3>() += q;
      normal.topRightCorner<3, 3>() += dt * q;
      normal.bottomRightCorner<3, 3>() += dt * dt * q;
      right.head<3>() += qs;
      right.tail<3>() += dt * qs;
    }
    normal.bottomLeftCorner<3, 3>() = normal.topRightCorner<3, 3>().transpose();
    const Eigen::SelfAdjointEigenSolver<KnotMatrix> solver(normal);
    const KnotState& values = solver.eigenvalues();
    if (!(values[0] > 1e-12 * values[5])) return std::nullopt;
    state = solver.eigenvectors() * (solver.eigenvectors().transpose() * right).cwiseQuotient(values);
    for (std::size_t i = 0; i < count; ++i) {
      const AirRay& ray = rays[i * stride];
      const Eigen::Vector3d gap = centre + state.head<3>() + (ray.time - time) * state.tail<3>() - ray.water_point;
      distances[i] = gap.cross(ray.direction).norm();
    }
    const double scale = std::max(Median(distances), 1e-6);
    for (std::size_t i = 0; i < count; ++i) {
      const double e = distances[i] / scale;
      weights[i] = 1 / (1 + e * e);
    }
  }
  state.head<3>() += centre;
  return state;
}

namespace {

struct Place {
  double time;
  std::uint32_t ray;
};

// The finalizer of a 64-bit hash: every bit of the input changes half of the bits of the result.
std::uint64_t Mixed(std::uint64_t x) {
  x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdULL;
  x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53ULL;
  return x ^ (x >> 33);
}

// Rays of greater rank stay.
std::uint64_t Rank(const AirRay& ray) {
  const auto separation_class = static_cast<std::uint64_t>(64 + std::floor(2 * std::log2(ray.separation)));
  return separation_class << 48 | Mixed(std::bit_cast<std::uint64_t>(ray.time)) >> 16;
}

bool IsFinite(const AirRay& ray) {
  return std::isfinite(ray.time) && ray.water_point.allFinite() && ray.direction.allFinite() &&
         std::isfinite(ray.separation) && ray.separation > 0;
}

}  // namespace

std::vector<AirRay> ThinRays(std::span<const AirRay> rays, const RayThinning& thinning) {
  std::vector<Place> places;
  places.reserve(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (IsFinite(rays[i])) places.push_back({rays[i].time, static_cast<std::uint32_t>(i)});
  tbb::parallel_sort(places,
                     [](const Place& a, const Place& b) { return a.time != b.time ? a.time < b.time : a.ray < b.ray; });

  const auto bin_of = [&](const Place& place) { return std::floor(place.time / thinning.bin); };
  std::size_t bins = 0;
  for (std::size_t i = 0; i < places.size(); ++i) bins += i == 0 || bin_of(places[i]) != bin_of(places[i - 1]);
  const std::size_t cap =
      std::clamp<std::size_t>(thinning.max_rays / std::max<std::size_t>(bins, 1), 1, thinning.rays_per_bin);

  std::vector<AirRay> kept;
  kept.reserve(std::min(places.size(), bins * cap));
  std::vector<std::pair<std::uint64_t, std::uint32_t>> ranked;
  for (std::size_t first = 0, last = 0; first < places.size(); first = last) {
    while (last < places.size() && bin_of(places[last]) == bin_of(places[first])) ++last;
    ranked.clear();
    for (std::size_t i = first; i < last; ++i)
      ranked.emplace_back(Rank(rays[places[i].ray]), static_cast<std::uint32_t>(i));
    if (ranked.size() > cap) {
      std::nth_element(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(cap), ranked.end(),
                       [](const auto& a, const auto& b) { return a > b; });
      ranked.resize(cap);
      std::sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    }
    for (const auto& [rank, i] : ranked) kept.push_back(rays[places[i].ray]);
  }
  return kept;
}

}  // namespace albtpu
