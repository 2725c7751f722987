#include "budget/beams/track_spline.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>

namespace albtpu {
namespace {

// F of a step.
KnotMatrix Transition(double step) {
  KnotMatrix f = KnotMatrix::Identity();
  f.topRightCorner<3, 3>().diagonal().setConstant(step);
  return f;
}

// The inverse of cov d for q = 1.
KnotMatrix MotionInformation(double step) {
  KnotMatrix m = KnotMatrix::Zero();
  m.topLeftCorner<3, 3>().diagonal().setConstant(12 / (step * step * step));
  m.topRightCorner<3, 3>().diagonal().setConstant(-6 / (step * step));
  m.bottomLeftCorner<3, 3>() = m.topRightCorner<3, 3>();
  m.bottomRightCorner<3, 3>().diagonal().setConstant(4 / step);
  return m;
}

}  // namespace

KnotPlace KnotTimes::Find(double time) const {
  assert(count >= 2);
  const double steps = std::clamp((time - start) / step, 0.0, static_cast<double>(count - 1));
  const std::size_t first = std::min(static_cast<std::size_t>(steps), count - 2);
  const double s = steps - static_cast<double>(first);
  return {
      .first = first,
      .fraction = s,
      .position = {1 - s * s * (3 - 2 * s), step * s * (1 - s) * (1 - s), s * s * (3 - 2 * s), -step * s * s * (1 - s)},
      .rate = {-6 * s * (1 - s) / step, (1 - s) * (1 - 3 * s), 6 * s * (1 - s) / step, s * (3 * s - 2)}};
}

double KnotTimes::BridgeVariance(double fraction, double density) const {
  const double s = step * fraction * (1 - fraction);
  return density * s * s * s / 3;
}

KnotEquations::KnotEquations(std::size_t knots)
    : diagonal(knots, KnotMatrix::Zero()), upper(knots - 1, KnotMatrix::Zero()), right(knots, KnotState::Zero()) {}

void KnotEquations::AddPosition(const KnotPlace& place, const Eigen::Matrix3d& information) {
  const auto& w = place.position;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      diagonal[place.first].block<3, 3>(3 * i, 3 * j) += w[i] * w[j] * information;
      diagonal[place.first + 1].block<3, 3>(3 * i, 3 * j) += w[2 + i] * w[2 + j] * information;
      upper[place.first].block<3, 3>(3 * i, 3 * j) += w[i] * w[2 + j] * information;
    }
  }
}

void KnotEquations::AddMotion(double step, double density, const std::vector<KnotState>& states) {
  const KnotMatrix f = Transition(step);
  const KnotMatrix information = MotionInformation(step) / density;
  const KnotMatrix back = f.transpose() * information;
  for (std::size_t k = 0; k + 1 < states.size(); ++k) {
    const KnotState d = states[k + 1] - f * states[k];
    diagonal[k] += back * f;
    diagonal[k + 1] += information;
    upper[k] -= back;
    right[k] += back * d;
    right[k + 1] -= information * d;
  }
}

Eigen::Matrix3d KnotSolution::PositionCovariance(const KnotPlace& place) const {
  const auto& w = place.position;
  const std::size_t k = place.first;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const Eigen::Matrix3d cross = covariance_next[k].block<3, 3>(3 * i, 3 * j);
      sum += w[i] * w[j] * covariance[k].block<3, 3>(3 * i, 3 * j) +
             w[2 + i] * w[2 + j] * covariance[k + 1].block<3, 3>(3 * i, 3 * j) +
             w[i] * w[2 + j] * (cross + cross.transpose());
    }
  }
  return (sum + sum.transpose()) / 2;
}

KnotSolution Solve(const KnotEquations& equations) {
  const std::size_t n = equations.diagonal.size();
  // Forward: the Schur complements, whose inverses are kept, and the right sides.
  std::vector<KnotMatrix> inverse(n);
  std::vector<KnotState> right = equations.right;
  KnotMatrix schur = equations.diagonal[0];
  for (std::size_t k = 0; k < n; ++k) {
    if (k > 0) {
      const KnotMatrix down = equations.upper[k - 1].transpose() * inverse[k - 1];
      schur = equations.diagonal[k] - down * equations.upper[k - 1];
      right[k] -= down * right[k - 1];
    }
    inverse[k] = schur.ldlt().solve(KnotMatrix::Identity());
    inverse[k] = (inverse[k] + inverse[k].transpose()).eval() / 2;
  }
  KnotSolution solution{std::vector<KnotState>(n), std::vector<KnotMatrix>(n), std::vector<KnotMatrix>(n - 1)};
  solution.states[n - 1] = inverse[n - 1] * right[n - 1];
  solution.covariance[n - 1] = inverse[n - 1];
  for (std::size_t k = n - 1; k-- > 0;) {
    const KnotMatrix gain = inverse[k] * equations.upper[k];
    solution.states[k] = inverse[k] * right[k] - gain * solution.states[k + 1];
    solution.covariance_next[k] = -gain * solution.covariance[k + 1];
    solution.covariance[k] = inverse[k] - solution.covariance_next[k] * gain.transpose();
  }
  return solution;
}

double MotionRoughness(double step, const std::vector<KnotState>& states, const KnotSolution& solution) {
  const KnotMatrix f = Transition(step);
  const KnotMatrix information = MotionInformation(step);
  double sum = 0;
  for (std::size_t k = 0; k + 1 < states.size(); ++k) {
    const KnotState d = states[k + 1] - f * states[k];
    const KnotMatrix cross = f * solution.covariance_next[k];
    const KnotMatrix spread = d * d.transpose() + solution.covariance[k + 1] +
                              f * solution.covariance[k] * f.transpose() - cross - cross.transpose();
    sum += information.cwiseProduct(spread).sum();
  }
  return sum;
}

}  // namespace albtpu
