#include "sea/response/unresolved_waves.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "sea/response/refraction.h"

namespace albtpu {
namespace {

// Gauss-Hermite nodes and weights of seven points for the standard normal distribution (Abramowitz and
// Stegun, table 25.10, nodes times sqrt 2, weights over sqrt pi): exact for polynomials up to degree 13.
constexpr std::array<double, 7> kHermiteNodes = {
    -3.750439717725742, -2.366759410734541, -1.154405394739968, 0,
    1.154405394739968,  2.366759410734541,  3.750439717725742};
constexpr std::array<double, 7> kHermiteWeights = {0.000548268855972, 0.030757123967586, 0.240123178605013,
                                                   0.457142857142857, 0.240123178605013, 0.030757123967586,
                                                   0.000548268855972};

}  // namespace

UnresolvedWaves EffectOfUnresolvedWaves(const BeamOptions& beam, double refractive_index,
                                        const Eigen::Matrix2d& slope_covariance) {
  const Eigen::Vector2d azimuth(std::cos(beam.azimuth), std::sin(beam.azimuth));
  const Eigen::Vector3d incident =
      (Eigen::Vector3d() << std::sin(beam.incidence) * azimuth, -std::cos(beam.incidence)).finished();
  const Eigen::Vector2d facing = std::tan(beam.incidence) * azimuth;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(slope_covariance);
  const Eigen::Matrix2d deviation =
      axes.eigenvectors() * axes.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();

  const auto tangents_and_secant = [&](const Eigen::Vector2d& slope) {
    const Eigen::Vector3d refracted = Refract(incident, NormalOfSlope(slope), refractive_index);
    return Eigen::Vector3d(Eigen::Vector3d(refracted.x(), refracted.y(), 1) / -refracted.z());
  };
  const auto change = [&](const Eigen::Vector2d& slope) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0;
    for (int i = 0; i < 7; ++i) {
      for (int j = 0; j < 7; ++j) {
        const Eigen::Vector2d tilted =
            slope + deviation * Eigen::Vector2d(kHermiteNodes[i], kHermiteNodes[j]);
        const double facing_area = std::max(0.0, 1 + facing.dot(tilted));  // 0 if turned away
        const double weight = kHermiteWeights[i] * kHermiteWeights[j] * facing_area;
        sum += weight * tangents_and_secant(tilted);
        weights += weight;
      }
    }
    return Eigen::Vector3d(sum / weights - tangents_and_secant(slope));
  };

  constexpr double kStep = 0.05;  // of slope: within the range of the resolved slopes, far above rounding
  UnresolvedWaves effect;
  effect.offset = change(Eigen::Vector2d::Zero());
  const Eigen::Vector2d x = kStep * Eigen::Vector2d::UnitX(), y = kStep * Eigen::Vector2d::UnitY();
  const auto first = [&](const Eigen::Vector2d& step) {
    return Eigen::Vector3d((change(step) - change(-step)) / (2 * kStep));
  };
  const auto second = [&](const Eigen::Vector2d& step) {
    return Eigen::Vector3d((change(step) + change(-step) - 2 * effect.offset) / (2 * kStep * kStep));
  };
  effect.gain << first(x), first(y);
  effect.curvature << second(x), second(y),
      (change(x + y) + change(-x - y) - change(x - y) - change(y - x)) / (4 * kStep * kStep);
  return effect;
}

}  // namespace albtpu
