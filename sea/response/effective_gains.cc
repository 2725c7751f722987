#include "sea/response/effective_gains.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "sea/quadrature/gauss_quadrature.h"
#include "sea/response/refraction.h"

namespace albtpu {

EffectiveGains EffectiveGainsOf(double incidence, double refractive_index, const Eigen::Matrix2d& slopes) {
  static const std::vector<QuadratureNode> nodes = GaussHermite(10);
  const Eigen::Vector3d incident(std::sin(incidence), 0, -std::cos(incidence));
  const double tau = std::tan(incidence);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(slopes);
  const Eigen::Matrix2d deviation =
      axes.eigenvectors() * axes.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();

  // E_w[F(m + shift)] for shifts of -1, 0 and 1 steps along both axes: its derivatives by the shift at 0 are E_w of the
  // derivatives of F.
  constexpr double kStep = 1e-3;
  Eigen::Vector3d shifted[3][3];
  for (auto& row : shifted) std::fill(std::begin(row), std::end(row), Eigen::Vector3d::Zero());
  Eigen::Vector3d unweighted = Eigen::Vector3d::Zero();
  double weights = 0;
  for (const QuadratureNode& first : nodes) {
    for (const QuadratureNode& second : nodes) {
      const Eigen::Vector2d slope = deviation * Eigen::Vector2d(first.at, second.at);
      const double share = first.weight * second.weight;
      const double weight = share * std::max(0.0, 1 + tau * slope.x());  // 0 if turned away
      weights += weight;
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          const RefractedRay ray =
              RefractAtSlope(incident, slope + kStep * Eigen::Vector2d(i - 1, j - 1), refractive_index);
          const Eigen::Vector3d value(ray.tangent.x(), ray.tangent.y(), ray.secant);
          shifted[i][j] += weight * value;
          if (i == 1 && j == 1) unweighted += share * value;
        }
      }
    }
  }
  for (auto& row : shifted) {
    for (Eigen::Vector3d& value : row) value /= weights;
  }

  EffectiveGains gains;
  gains.mean = shifted[1][1];
  gains.gain.col(0) = (shifted[2][1] - shifted[0][1]) / (2 * kStep) + tau * (unweighted - gains.mean);
  gains.gain.col(1) = (shifted[1][2] - shifted[1][0]) / (2 * kStep);
  const Eigen::Vector3d xx = shifted[2][1] + shifted[0][1] - 2 * gains.mean;
  const Eigen::Vector3d yy = shifted[1][2] + shifted[1][0] - 2 * gains.mean;
  const Eigen::Vector3d xy = (shifted[2][2] + shifted[0][0] - shifted[2][0] - shifted[0][2]) / 4;
  for (int i = 0; i < 3; ++i) {
    gains.curvature[i] << xx[i], xy[i], xy[i], yy[i];
    gains.curvature[i] /= kStep * kStep;
  }
  return gains;
}

}  // namespace albtpu
