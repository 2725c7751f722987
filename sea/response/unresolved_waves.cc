#include "sea/response/unresolved_waves.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sea/quadrature/gauss_quadrature.h"
#include "sea/response/refraction.h"

namespace albtpu {
namespace {

// The square root of a covariance: it takes two independent standard normal variables to the slopes. Deviations below
// `least` are taken as that.
Eigen::Matrix2d RootOf(const Eigen::Matrix2d& covariance, double least) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance);
  const Eigen::Vector2d deviations = axes.eigenvalues().cwiseMax(least * least).cwiseSqrt();
  return axes.eigenvectors() * deviations.asDiagonal();
}

}  // namespace

UnresolvedWaves EffectOfUnresolvedWaves(const BeamOptions& beam, double refractive_index,
                                        const Eigen::Matrix2d& unresolved, const Eigen::Matrix2d& resolved) {
  static const std::vector<QuadratureNode> fine = GaussHermite(7), coarse = GaussHermite(3);
  const Eigen::Vector2d azimuth(std::cos(beam.azimuth), std::sin(beam.azimuth));
  const Eigen::Vector3d incident =
      (Eigen::Vector3d() << std::sin(beam.incidence) * azimuth, -std::cos(beam.incidence)).finished();
  const Eigen::Vector2d facing = std::tan(beam.incidence) * azimuth;

  const auto tangents_and_secant = [&](const Eigen::Vector2d& slope) {
    const RefractedRay ray = RefractAtSlope(incident, slope, refractive_index);
    return Eigen::Vector3d(ray.tangent.x(), ray.tangent.y(), ray.secant);
  };
  const Eigen::Matrix2d unresolved_root = RootOf(unresolved, 0);
  const auto change = [&](const Eigen::Vector2d& slope) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0;
    for (const QuadratureNode& x : fine) {
      for (const QuadratureNode& y : fine) {
        const Eigen::Vector2d tilted = slope + unresolved_root * Eigen::Vector2d(x.at, y.at);
        const double facing_area = std::max(0.0, 1 + facing.dot(tilted));  // 0 if turned away
        const double weight = x.weight * y.weight * facing_area;
        sum += weight * tangents_and_secant(tilted);
        weights += weight;
      }
    }
    return Eigen::Vector3d(sum / weights - tangents_and_secant(slope));
  };

  // With u the standard normal variables of the resolved slopes, the factors of the Hermite polynomials u_i and
  // u_i u_j - delta_ij are the means of the change times them.
  const Eigen::Matrix2d root = RootOf(resolved, 1e-3);  // of slope: far above rounding
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 2> first = Eigen::Matrix<double, 3, 2>::Zero();
  std::array<Eigen::Matrix2d, 3> second = {Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero(),
                                           Eigen::Matrix2d::Zero()};
  for (const QuadratureNode& x : coarse) {
    for (const QuadratureNode& y : coarse) {
      const Eigen::Vector2d u(x.at, y.at);
      const Eigen::Vector3d share = x.weight * y.weight * change(root * u);
      mean += share;
      first += share * u.transpose();
      for (int i = 0; i < 3; ++i) {
        second[i] += share[i] * (u * u.transpose() - Eigen::Matrix2d::Identity());
      }
    }
  }
  const Eigen::Matrix2d inverse = root.inverse();  // u of the slope
  UnresolvedWaves effect;
  effect.gain = first * inverse;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Matrix2d form = 0.5 * inverse.transpose() * second[i] * inverse;
    effect.offset[i] = mean[i] - 0.5 * second[i].trace();
    effect.curvature.row(i) << form(0, 0), form(1, 1), 2 * form(0, 1);
  }
  return effect;
}

}  // namespace albtpu
