#include "budget/beams/track_spline.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

namespace albtpu {
namespace {

// Measurements of position at five times over six seconds, and the motion.
KnotEquations Measured(const KnotTimes& times, double density) {
  KnotEquations equations(times.count);
  for (const double time : {0.0, 1.5, 3.0, 4.5, 6.0}) {
    Eigen::Matrix3d information;
    information << 2 + time, 0.3, 0, 0.3, 4, -0.2, 0, -0.2, 1;
    equations.AddPosition(times.Find(time), information);
  }
  equations.AddMotion(times.step, density, std::vector<KnotState>(times.count, KnotState::Zero()));
  return equations;
}

Eigen::MatrixXd Dense(const KnotEquations& equations) {
  const auto n = static_cast<Eigen::Index>(equations.diagonal.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(6 * n, 6 * n);
  for (Eigen::Index k = 0; k < n; ++k) {
    matrix.block<6, 6>(6 * k, 6 * k) = equations.diagonal[static_cast<std::size_t>(k)];
    if (k + 1 == n) continue;
    matrix.block<6, 6>(6 * k, 6 * k + 6) = equations.upper[static_cast<std::size_t>(k)];
    matrix.block<6, 6>(6 * k + 6, 6 * k) = equations.upper[static_cast<std::size_t>(k)].transpose();
  }
  return matrix;
}

TEST(TrackSpline, ReproducesACubic) {
  const KnotTimes times{10, 1.5, 4};
  const auto cubic = [](double t) { return 1 + t * (2 + t * (-0.5 + 0.1 * t)); };
  const auto rate = [](double t) { return 2 + t * (-1 + 0.3 * t); };
  for (double t = 10; t <= 14.5; t += 0.1) {
    const KnotPlace at = times.Find(t);
    const double a = times.TimeOf(at.first), b = times.TimeOf(at.first + 1);
    const std::array<double, 4> states{cubic(a), rate(a), cubic(b), rate(b)};
    double position = 0, velocity = 0;
    for (std::size_t j = 0; j < 4; ++j) position += at.position[j] * states[j], velocity += at.rate[j] * states[j];
    EXPECT_NEAR(position, cubic(t), 1e-11);
    EXPECT_NEAR(velocity, rate(t), 1e-11);
  }
}

TEST(TrackSpline, SolvesAndInvertsAsADenseMatrixDoes) {
  const KnotTimes times{0, 1.5, 5};
  KnotEquations equations = Measured(times, 0.7);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Eigen::VectorXd right(30);
  for (Eigen::Index i = 0; i < 30; ++i) right[i] = normal(random);
  for (std::size_t k = 0; k < 5; ++k) equations.right[k] = right.segment<6>(static_cast<Eigen::Index>(6 * k));
  const Eigen::MatrixXd inverse = Dense(equations).inverse();
  const Eigen::VectorXd states = inverse * right;
  const KnotSolution solution = Solve(equations);
  for (std::size_t k = 0; k < 5; ++k) {
    const auto at = static_cast<Eigen::Index>(6 * k);
    EXPECT_LT((solution.states[k] - states.segment<6>(at)).norm(), 1e-10 * states.norm());
    EXPECT_LT((solution.covariance[k] - inverse.block<6, 6>(at, at)).norm(), 1e-10 * inverse.norm());
    if (k == 4) continue;
    EXPECT_LT((solution.covariance_next[k] - inverse.block<6, 6>(at, at + 6)).norm(), 1e-10 * inverse.norm());
  }
}

// The prior is a process in continuous time: knots between the measurements change nothing.
TEST(TrackSpline, HasTheSameVarianceBetweenKnotsAsWithFinerKnots) {
  const double density = 0.7;
  const KnotTimes coarse{0, 1.5, 5}, fine{0, 0.25, 25};
  const KnotSolution by_coarse = Solve(Measured(coarse, density)), by_fine = Solve(Measured(fine, density));
  for (std::size_t k = 0; k < fine.count; ++k) {
    const KnotPlace at = coarse.Find(fine.TimeOf(k));
    Eigen::Matrix3d expected = by_coarse.PositionCovariance(at);
    expected.diagonal().array() += coarse.BridgeVariance(at.fraction, density);
    EXPECT_LT((by_fine.covariance[k].topLeftCorner<3, 3>() - expected).norm(), 1e-9 * expected.norm()) << k;
  }
}

// Tracks drawn from the prior of q = 0.7 have a roughness of 6 q for each step.
TEST(TrackSpline, MeasuresTheRoughnessOfItsOwnPrior) {
  constexpr double kStep = 1.5, kDensity = 0.7;
  constexpr std::size_t kKnots = 20001;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<KnotState> states{KnotState::Zero()};
  // The Cholesky factor of [h^3/3 h^2/2; h^2/2 h].
  const double a = std::sqrt(kStep * kStep * kStep / 3), b = kStep * kStep / 2 / a, c = std::sqrt(kStep - b * b);
  for (std::size_t k = 1; k < kKnots; ++k) {
    KnotState next = states.back();
    next.head<3>() += kStep * next.tail<3>();
    for (int axis = 0; axis < 3; ++axis) {
      const double x = std::sqrt(kDensity) * normal(random), y = std::sqrt(kDensity) * normal(random);
      next[axis] += a * x;
      next[3 + axis] += b * x + c * y;
    }
    states.push_back(next);
  }
  const KnotSolution certain{
      {}, std::vector<KnotMatrix>(kKnots, KnotMatrix::Zero()), std::vector<KnotMatrix>(kKnots - 1, KnotMatrix::Zero())};
  const double freedom = 6.0 * (kKnots - 1);
  // Chi-squared: its relative standard error is sqrt(2 / freedom) = 0.4 %; positions of 1e6 m cost 1e-9 of each.
  EXPECT_NEAR(MotionRoughness(kStep, states, certain) / (freedom * kDensity), 1, 4 * std::sqrt(2 / freedom));
}

}  // namespace
}  // namespace albtpu
