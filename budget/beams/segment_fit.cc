#include "budget/beams/segment_fit.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "budget/beams/displacement_fit.h"
#include "sea/samples.h"

namespace albtpu {
namespace {

constexpr std::size_t kBinsPerStep = 30;     // Of rays that share a derivative; 0.05 s.
constexpr double kLongestCorrelation = 0.5;  // s; waves of tens of metres pass under a scan line.
constexpr double kShortestStep = 0.1;        // s between the knots of a short segment.
constexpr int kMinIterations = 8, kMaxIterations = 25;
constexpr double kConverged = 1e-3;  // m; a hundredth of the accuracy that is needed.

// q: the prior is one step with the density of light turbulence; the bounds lie far below and far above any flight.
constexpr double kUsualDensity = 0.3, kMinDensity = 0.003, kMaxDensity = 30;

// Rays of a bin of time: their information on the position, their scores, and the scores times the weights of the
// four states of the knots around them.
struct Bin {
  std::size_t first = 0, last = 0;  // Rays.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d score = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 4> scores = Eigen::Matrix<double, 3, 4>::Zero();
  double weight = 0, response = 0, mean_time = 0;
};

class SegmentFit {
 public:
  SegmentFit(std::span<const AirRay> rays, const RayTrackOptions& options);
  bool Start();
  void Iterate();
  RaySegment Result() const;

 private:
  Eigen::Vector3d Position(const KnotPlace& place) const;
  void ComputeResiduals();
  void FillBins();
  double MedianIncidence() const;
  // The covariance of positions from all rays relative to that of independent errors, in the axes of the root of the
  // information: K of B = L K L', A = L L'.
  Eigen::Matrix3d Correlation(const Eigen::Matrix3d& root, const KnotSolution* solution, double last) const;
  KnotEquations Equations(const Eigen::Matrix3d& shaping, double scale) const;

  std::span<const AirRay> rays_;
  const RayTrackOptions& options_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  KnotTimes times_{};
  std::vector<KnotState> states_;
  std::vector<Bin> bins_;
  std::vector<double> squares_, separations_;
  RayNoise noise_;
  double correlation_ = 1, density_ = kUsualDensity;
  double flattening_ = 0;  // rad per sine of the incidence.
  KnotSolution solution_;
};

SegmentFit::SegmentFit(std::span<const AirRay> rays, const RayTrackOptions& options)
    : rays_(rays), options_(options), squares_(rays.size()), separations_(rays.size()) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    centre_ += rays[i].water_point / static_cast<double>(rays.size());
    separations_[i] = rays[i].separation;
  }
  const double duration = rays.back().time - rays.front().time;
  const auto steps = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(duration / options.knot_step - 1e-9)));
  times_ = {.start = rays.front().time,
            .step = std::max(duration / static_cast<double>(steps), kShortestStep),
            .count = steps + 1};
  bins_.resize(steps * kBinsPerStep);
  const double width = times_.step / kBinsPerStep;
  std::size_t ray = 0;
  for (std::size_t b = 0; b < bins_.size(); ++b) {
    const double end = times_.start + width * static_cast<double>(b + 1);
    bins_[b].first = ray;
    while (ray < rays.size() && (rays[ray].time < end || b + 1 == bins_.size())) ++ray;
    bins_[b].last = ray;
  }
}

// Around each knot a window of two steps, or as many as hold enough rays. A window without a plausible track takes the
// state of the nearest window that has one.
bool SegmentFit::Start() {
  constexpr std::size_t kEnoughRays = 40;
  constexpr double kWidest = 4;
  const auto at = [&](double time) {
    return static_cast<std::size_t>(
        std::lower_bound(rays_.begin(), rays_.end(), time, [](const AirRay& ray, double t) { return ray.time < t; }) -
        rays_.begin());
  };
  std::vector<std::optional<KnotState>> found(times_.count);
  tbb::parallel_for(std::size_t{0}, times_.count, [&](std::size_t k) {
    const double time = times_.TimeOf(k);
    for (double half = 1; half <= kWidest; half *= 2) {
      const std::size_t first = at(time - half * times_.step), last = at(time + half * times_.step);
      const auto window = rays_.subspan(first, last - first);
      if (window.size() < kEnoughRays && half < kWidest && window.size() < rays_.size()) continue;
      if (auto state = WhereRaysMeet(window, time)) {
        state->head<3>() -= centre_;
        if (state->z() > 0 && state->z() < options_.max_height && state->tail<3>().norm() < options_.max_speed) {
          found[k] = state;
          return;
        }
      }
    }
  });
  states_.resize(times_.count);
  bool any = false;
  for (std::size_t k = 0; k < times_.count; ++k) {
    for (std::size_t off = 0; off < times_.count; ++off) {
      const auto take = [&](std::size_t from) {
        if (from >= times_.count || !found[from]) return false;
        states_[k] = *found[from];
        states_[k].head<3>() += (times_.TimeOf(k) - times_.TimeOf(from)) * states_[k].tail<3>();
        return true;
      };
      if (take(k + off) || (off <= k && take(k - off))) {
        any = true;
        break;
      }
    }
  }
  return any;
}

Eigen::Vector3d SegmentFit::Position(const KnotPlace& place) const {
  const KnotState& a = states_[place.first];
  const KnotState& b = states_[place.first + 1];
  const auto& w = place.position;
  return w[0] * a.head<3>() + w[1] * a.tail<3>() + w[2] * b.head<3>() + w[3] * b.tail<3>();
}

void SegmentFit::ComputeResiduals() {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays_.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Eigen::Vector3d to = rays_[i].water_point - centre_ - Position(times_.Find(rays_[i].time));
      squares_[i] = AngleBetween(to.normalized(), rays_[i].direction, flattening_).squaredNorm();
    }
  });
}

void SegmentFit::FillBins() {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bins_.size(), 16), [&](const auto& range) {
    for (std::size_t b = range.begin(); b < range.end(); ++b) {
      Bin bin{.first = bins_[b].first, .last = bins_[b].last};
      for (std::size_t i = bin.first; i < bin.last; ++i) {
        const AirRay& ray = rays_[i];
        const KnotPlace place = times_.Find(ray.time);
        const Eigen::Vector3d to = ray.water_point - centre_ - Position(place);
        const double range_squared = to.squaredNorm(), distance = std::sqrt(range_squared);
        const Eigen::Vector3d v = to / distance;
        const Eigen::Vector3d residual = AngleBetween(v, ray.direction, flattening_);
        const RayWeight w = WeightOf(noise_, ray.separation, residual.squaredNorm());
        // The rays' directions turn towards +x when the sensor moves towards -x.
        const Eigen::Vector3d score = -w.weight / distance * residual;
        bin.information += w.weight / range_squared * (Eigen::Matrix3d::Identity() - v * v.transpose());
        bin.score += score;
        for (int j = 0; j < 4; ++j) bin.scores.col(j) += place.position[static_cast<std::size_t>(j)] * score;
        bin.weight += w.weight;
        bin.response += w.response;
        bin.mean_time += ray.time - times_.start;
      }
      if (bin.last > bin.first) bin.mean_time /= static_cast<double>(bin.last - bin.first);
      bin.mean_time += times_.start;
      bins_[b] = bin;
    }
  });
}

// Of the rays themselves, whose errors are small beside it.
double SegmentFit::MedianIncidence() const {
  std::vector<double> incidences;
  const std::size_t stride = rays_.size() / 2000 + 1;
  for (std::size_t i = 0; i < rays_.size(); i += stride)
    incidences.push_back(std::atan2(rays_[i].direction.head<2>().norm(), -rays_[i].direction.z()));
  return Median(std::move(incidences));
}

Eigen::Matrix3d SegmentFit::Correlation(const Eigen::Matrix3d& root, const KnotSolution* solution, double last) const {
  const double width = times_.step / kBinsPerStep;
  const double duration = static_cast<double>(bins_.size()) * width;
  const auto whitened = [&](const Eigen::Matrix3d& m) -> Eigen::Matrix3d {
    const Eigen::Matrix3d half = root.triangularView<Eigen::Lower>().solve(m);
    return root.triangularView<Eigen::Lower>().solve(half.transpose());
  };
  Eigen::Matrix3d fitted = Eigen::Matrix3d::Zero();
  double weight = 0, response = 0;
  for (const Bin& bin : bins_) {
    weight += bin.weight;
    response += bin.response;
    if (solution == nullptr || bin.first == bin.last) continue;
    fitted += bin.information * solution->PositionCovariance(times_.Find(bin.mean_time)) * bin.information;
  }
  // The fit takes the fraction f from the scores at lags far below the step of the knots: of their variance A_c K, it
  // takes A_c C A_c in each of the lags, which Bartlett's weights count lags + 1 times.
  const double f_per_lag = whitened(fitted).trace() / (3 * last);
  // A lag of more than a tenth of a segment has too few pairs of bins, and the fraction that the fit takes is limited.
  constexpr double kMaxShare = 0.3;
  const double longest =
      std::min({kLongestCorrelation / width, duration / 10 / width, kMaxShare / std::max(f_per_lag, 1e-9) - 1});
  const auto lags = static_cast<std::size_t>(std::max(longest, 0.0));
  const double f = std::min(static_cast<double>(lags + 1) * f_per_lag, 0.6);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t lag = 0; lag <= lags; ++lag) {
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    for (std::size_t b = lag; b < bins_.size(); ++b) products += bins_[b - lag].score * bins_[b].score.transpose();
    const double bartlett = 1 - static_cast<double>(lag) / static_cast<double>(lags + 1);
    sum += lag == 0 ? products : (bartlett * (products + products.transpose())).eval();
  }
  // Redescending weights reduce the curvature of the likelihood below A.
  const double curvature = std::clamp(response / weight, 0.3, 1.0);
  Eigen::Matrix3d k = whitened(sum) / (curvature * curvature * (1 - f));
  // Each correlation time is one observation of K. A few more observations of K = 1 keep a short segment, whose errors
  // may cancel by chance, from an optimistic K.
  constexpr double kUsual = 4, kLeast = 0.4;
  const double freedom = std::max(1.0, duration / (width * static_cast<double>(lags + 1)));
  const double student = WidthOfStudent(freedom + kUsual);
  k = (freedom * k + kUsual * Eigen::Matrix3d::Identity()) * (student * student / (freedom + kUsual));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver((k + k.transpose()) / 2);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(kLeast).asDiagonal() * solver.eigenvectors().transpose();
}

KnotEquations SegmentFit::Equations(const Eigen::Matrix3d& shaping, double scale) const {
  KnotEquations equations(times_.count);
  for (const Bin& bin : bins_) {
    if (bin.first == bin.last) continue;
    const KnotPlace place = times_.Find(bin.mean_time);
    equations.AddPosition(place, shaping.transpose() * bin.information * shaping * scale);
    equations.right[place.first].head<3>() += scale * bin.scores.col(0);
    equations.right[place.first].tail<3>() += scale * bin.scores.col(1);
    equations.right[place.first + 1].head<3>() += scale * bin.scores.col(2);
    equations.right[place.first + 1].tail<3>() += scale * bin.scores.col(3);
  }
  equations.AddMotion(times_.step, density_, states_);
  return equations;
}

void SegmentFit::Iterate() {
  const Eigen::Matrix3d unshaped = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d information, root, k = unshaped;
  const auto sum_up = [&] {
    information.setZero();
    for (const Bin& bin : bins_) information += bin.information;
    root = information.llt().matrixL();
  };
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    ComputeResiduals();
    if (iteration == 0) noise_ = RobustRayNoise(squares_, separations_);
    noise_ = FitRayNoise(squares_, separations_, noise_, iteration == 0 ? 10 : 3);
    if (iteration >= 2) {
      const double incidence = std::clamp(MedianIncidence(), 0.01, 1.2);
      const FacingSlopes slopes = FacingSlopesAt(incidence, options_.index);
      flattening_ = noise_.slopes * noise_.slopes / (slopes.gain * slopes.gain) * slopes.bias / std::sin(incidence);
    }
    FillBins();
    sum_up();
    if (iteration >= 3) {
      k = Correlation(root, &solution_, correlation_);
      correlation_ = k.trace() / 3;
    }
    solution_ = Solve(Equations(unshaped, 1 / correlation_));
    double greatest = 0;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      states_[i] += solution_.states[i];
      greatest = std::max(greatest, solution_.states[i].head<3>().norm());
    }
    if (iteration >= 2) {
      const double steps = static_cast<double>(times_.count - 1);
      const double before = density_;
      density_ = std::clamp((MotionRoughness(times_.step, states_, solution_) + 6 * kUsualDensity) / (6 * (steps + 1)),
                            kMinDensity, kMaxDensity);
      if (std::abs(density_ / before - 1) > 0.1) greatest = std::max(greatest, 2 * kConverged);
    }
    if (iteration + 1 >= kMinIterations && greatest < kConverged) break;
  }
  // The posterior at the solution: M of A_c -> M' A_c M with M = A^-1/2 (A^1/2 B^-1 A^1/2)^1/2 A^1/2 makes the
  // information of all bins together A B^-1 A, whose inverse is the covariance of correlated errors.
  FillBins();
  sum_up();
  k = Correlation(root, &solution_, correlation_);
  correlation_ = k.trace() / 3;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> a(information);
  const Eigen::Matrix3d b = root * k * root.transpose();
  const Eigen::Matrix3d inner = a.operatorSqrt() * b.inverse() * a.operatorSqrt();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> inner_solver((inner + inner.transpose()) / 2);
  const Eigen::Matrix3d shaping = a.operatorInverseSqrt() * inner_solver.operatorSqrt() * a.operatorSqrt();
  solution_ = Solve(Equations(shaping, 1));
}

RaySegment SegmentFit::Result() const {
  RaySegment segment{.start = rays_.front().time,
                     .end = rays_.back().time,
                     .rays = rays_.size(),
                     .noise = noise_,
                     .correlation = correlation_,
                     .acceleration = density_,
                     .times = times_,
                     .knots = solution_};
  segment.knots.states = states_;
  for (KnotState& state : segment.knots.states) state.head<3>() += centre_;
  std::vector<double> heights;
  for (const AirRay& ray : rays_) heights.push_back(ray.water_point.z());
  segment.water_height = Median(std::move(heights));
  segment.median_incidence = MedianIncidence();
  return segment;
}

}  // namespace

std::optional<RaySegment> FitSegment(std::span<const AirRay> rays, const RayTrackOptions& options) {
  if (rays.size() < std::max<std::size_t>(options.min_rays, 6) || !(rays.back().time > rays.front().time))
    return std::nullopt;
  SegmentFit fit(rays, options);
  if (!fit.Start()) return std::nullopt;
  fit.Iterate();
  RaySegment segment = fit.Result();
  for (const KnotState& state : segment.knots.states)
    if (!state.allFinite()) return std::nullopt;
  return segment;
}

}  // namespace albtpu
