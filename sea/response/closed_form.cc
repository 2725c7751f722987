#include "sea/response/closed_form.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "sea/principal_axes.h"
#include "sea/quadrature/hankel_lattice.h"

namespace albtpu {
double StillWaterRefraction(double incidence, double n) { return std::asin(std::sin(incidence) / n); }

SlopeGain SmallSlopeGain(double incidence, double n) {
  const double cos_refracted = std::cos(StillWaterRefraction(incidence, n));
  const double g = 1 - std::cos(incidence) / (n * cos_refracted);
  return {g / (cos_refracted * cos_refracted), g};
}

Eigen::Matrix2d TangentResponse(double incidence, double azimuth, double n) {
  const SlopeGain gain = SmallSlopeGain(incidence, n);
  const Eigen::Vector2d along(std::cos(azimuth), std::sin(azimuth));
  return gain.out_of_plane * Eigen::Matrix2d::Identity() +
         (gain.in_plane - gain.out_of_plane) * along * along.transpose();
}

// By central differences, whose error is some 1e-6 of the result.
Eigen::Matrix2d SecantCurvature(double incidence, double azimuth, double n) {
  constexpr double kStep = 1e-3;
  const Eigen::Vector3d incident(std::sin(incidence) * std::cos(azimuth), std::sin(incidence) * std::sin(azimuth),
                                 -std::cos(incidence));
  const auto secant = [&](double x, double y) {
    return RefractAtSlope(incident, Eigen::Vector2d(x, y) * kStep, n).secant;
  };
  const double xx = secant(1, 0) + secant(-1, 0) - 2 * secant(0, 0);
  const double yy = secant(0, 1) + secant(0, -1) - 2 * secant(0, 0);
  const double xy = (secant(1, 1) + secant(-1, -1) - secant(1, -1) - secant(-1, 1)) / 4;
  return (Eigen::Matrix2d() << xx, xy, xy, yy).finished() / (kStep * kStep);
}

EffectiveGains EffectiveGainsOf(double incidence, double refractive_index, const Eigen::Matrix2d& slopes) {
  static const std::vector<QuadratureNode> nodes = GaussHermite(10);
  const Eigen::Vector3d incident(std::sin(incidence), 0, -std::cos(incidence));
  const double tau = std::tan(incidence);
  const PrincipalAxes axes = PrincipalAxesOf(slopes);
  const Eigen::Matrix2d deviation = axes.directions * axes.variances.cwiseMax(0).cwiseSqrt().asDiagonal();

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
  for (auto& row : shifted)
    for (Eigen::Vector3d& value : row) value /= weights;

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

std::string_view Name(BeamProfile profile) { return profile == BeamProfile::kUniform ? "uniform" : "gaussian"; }

std::optional<BeamProfile> FindBeamProfile(std::string_view name) {
  for (const BeamProfile profile : {BeamProfile::kUniform, BeamProfile::kGaussian})
    if (name == Name(profile)) return profile;
  return std::nullopt;
}

double RelativeIrradiance(BeamProfile profile, double squared_radius) {
  if (profile == BeamProfile::kGaussian) return std::exp(-8 * squared_radius);
  return squared_radius < 0.25 ? 1 : 0;
}

double RadiusOfPower(BeamProfile profile, double power) {
  switch (profile) {
    case BeamProfile::kUniform:
      return 0.5 * std::sqrt(power);
    case BeamProfile::kGaussian:
      return std::sqrt(-std::log1p(-power) / 8);
  }
  return 0;
}

double FootprintOverlap(BeamProfile profile, double apart) {
  if (profile == BeamProfile::kGaussian) return std::exp(-4 * apart * apart);
  return apart < 1 ? 2 / std::numbers::pi * (std::acos(apart) - apart * std::sqrt(1 - apart * apart)) : 0;
}

double WidthOnWater(const BeamOptions& beam) {
  const double width = beam.profile == BeamProfile::kGaussian ? 2 * beam.footprint : beam.footprint;
  return width / std::cos(beam.incidence);
}

double FootprintAverage(const BeamOptions& beam, double k, double psi) {
  const double along = k * std::cos(psi - beam.azimuth) / std::cos(beam.incidence);
  const double across = k * std::sin(psi - beam.azimuth);
  const double kappa = std::hypot(along, across);
  if (beam.profile == BeamProfile::kGaussian) return std::exp(-kappa * kappa * beam.footprint * beam.footprint / 32);
  const double argument = kappa * beam.footprint / 2;
  if (argument < 1e-4) return 1;  // the next term of the series is -argument^2 / 8
  return 2 * ::j1(argument) / argument;
}

double FootprintPower(const BeamOptions& beam, double k, double psi) {
  const double average = FootprintAverage(beam, k, psi);
  return average * average;
}

SmallSlopeUncertainty ClosedForm(const SeaState& sea, const BeamOptions& beam, double refractive_index) {
  const Eigen::Matrix2d slopes =
      SlopeCovariance(sea, [&](double k, double psi) { return FootprintPower(beam, k, psi); });
  const Eigen::Vector2d azimuth(std::cos(beam.azimuth), std::sin(beam.azimuth));
  const Eigen::Matrix2d response = TangentResponse(beam.incidence, beam.azimuth, refractive_index);
  const Eigen::Matrix2d tangent = response * slopes * response.transpose();

  // To first order atan(t - t_still) is t - t_still. The path in still water is d / cos(theta_r), its derivative by
  // the in-plane tangent is d sin(theta_r), and the reported depth is the path times cos(theta_r).
  const double refracted = StillWaterRefraction(beam.incidence, refractive_index);
  const double in_plane = std::sqrt(azimuth.dot(tangent * azimuth));
  return {2 * std::sqrt(tangent(0, 0)), 2 * std::sqrt(tangent(1, 1)), 2 * std::sqrt(tangent.trace()),
          2 * in_plane * std::sin(refracted) * std::cos(refracted)};
}

namespace {

// The square root of a covariance: it takes two independent standard normal variables to the slopes. Deviations below
// `least` are taken as that.
Eigen::Matrix2d RootOf(const Eigen::Matrix2d& covariance, double least) {
  const PrincipalAxes axes = PrincipalAxesOf(covariance);
  const Eigen::Vector2d deviations = axes.variances.cwiseMax(least * least).cwiseSqrt();
  return axes.directions * deviations.asDiagonal();
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
  std::array<Eigen::Matrix2d, 3> second = {Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero()};
  for (const QuadratureNode& x : coarse) {
    for (const QuadratureNode& y : coarse) {
      const Eigen::Vector2d u(x.at, y.at);
      const Eigen::Vector3d share = x.weight * y.weight * change(root * u);
      mean += share;
      first += share * u.transpose();
      for (int i = 0; i < 3; ++i) second[i] += share[i] * (u * u.transpose() - Eigen::Matrix2d::Identity());
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
