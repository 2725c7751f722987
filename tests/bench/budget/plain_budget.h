// THU and TVU of one pulse at 2 sigma, as one would write them: vectors and matrices of Eigen in double precision.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "budget/total/budget_columns.h"

namespace albtpu::bench {

inline void PlainBudget(const BudgetInputs& inputs, std::size_t i, const BudgetOptions& options, double& thu,
                        double& tvu) {
  using Eigen::Matrix3d;
  using Eigen::Vector3d;
  constexpr double kDegree = std::numbers::pi / 180;
  const auto at = [&](BudgetInput input) -> double {
    const auto column = inputs[input];
    return column.empty() ? 0 : column[column.size() == 1 ? 0 : i];
  };
  const AirErrors& errors = options.errors;
  const double n = options.index;
  const double st = std::sin(kDegree * at(BudgetInput::kIncidence)),
               ct = std::cos(kDegree * at(BudgetInput::kIncidence));
  const double sa = std::sin(kDegree * at(BudgetInput::kBeamAzimuth)),
               ca = std::cos(kDegree * at(BudgetInput::kBeamAzimuth));
  const Vector3d u(st * ca, st * sa, ct);
  const double cw = std::sqrt(1 - st * st / (n * n));
  const Vector3d w(u.x() / n, u.y() / n, cw), k = u - w / n;
  const double rho = at(BudgetInput::kAltitude) / ct, s = at(BudgetInput::kDepth) / cw;
  const bool given = options.located == SurfaceLocation::kLevel;
  Matrix3d g = Matrix3d::Identity() * rho;
  g(0, 0) += s / n;
  g(1, 1) += s / n;
  g(2, 0) -= s * u.x() / (n * n * cw);
  g(2, 1) -= s * u.y() / (n * n * cw);
  Matrix3d g_scan = g, p = Matrix3d::Identity();
  if (options.located != SurfaceLocation::kPulse) g_scan.col(2) -= rho / ct * k;
  if (given) {
    g.col(2) -= rho / ct * k;
    p.col(2) -= k / ct;
  }
  const double sr = std::sin(kDegree * at(BudgetInput::kRoll)), cr = std::cos(kDegree * at(BudgetInput::kRoll));
  const double sp = std::sin(kDegree * at(BudgetInput::kPitch)), cp = std::cos(kDegree * at(BudgetInput::kPitch));
  const double sh = std::sin(kDegree * at(BudgetInput::kHeading)), ch = std::cos(kDegree * at(BudgetInput::kHeading));
  Matrix3d r;
  r << ch * cp, ch * sp * sr - sh * cr, ch * sp * cr + sh * sr, sh * cp, sh * sp * sr + ch * cr, sh * sp * cr - ch * sr,
      -sp, cp * sr, cp * cr;
  const Vector3d l = r * Vector3d(options.lever_arm.data());
  const Vector3d omega =
      r * (kDegree * Vector3d(at(BudgetInput::kRollRate), at(BudgetInput::kPitchRate), at(BudgetInput::kYawRate)));
  Matrix3d c = Matrix3d::Zero();
  const auto add = [&](const Vector3d& v) { c.noalias() += v * v.transpose(); };
  for (int a = 0; a < 3; ++a) add(errors.position[a] * p.col(a));
  const Vector3d axes[] = {r.col(0), Vector3d(-sh, ch, 0), Vector3d(0, 0, 1)};
  for (int a = 0; a < 3; ++a) add(kDegree * errors.attitude[a] * (g * axes[a].cross(u) + p * axes[a].cross(l)));
  for (int a = 0; a < 3; ++a) add(kDegree * errors.boresight[a] * (g * r.col(a).cross(u)));
  for (int a = 0; a < 3; ++a) add(errors.lever_arm * (p * r.col(a)));
  add(kDegree * errors.scan * (g_scan * Vector3d(ct * ca, ct * sa, -st)));
  add(kDegree * errors.scan * (g_scan * Vector3d(-sa, ca, 0)));
  const Vector3d velocity(at(BudgetInput::kVelocityNorth), at(BudgetInput::kVelocityEast),
                          at(BudgetInput::kVelocityDown));
  add(errors.time * (p * (velocity + omega.cross(l)) + g * omega.cross(u)));
  add(errors.range_offset * (given ? Vector3d(w / n) : u));
  add(errors.bottom_range / n * w);
  add(std::hypot(errors.surface_height, at(BudgetInput::kWaveHeight)) / ct * k);
  const Vector3d by_index(-2 * s * u.x() / (n * n), -2 * s * u.y() / (n * n),
                          s * (st * st / (n * n * n * cw) - cw / n));
  add(errors.index * by_index);
  const double along = at(BudgetInput::kRefractionAlong), cross = at(BudgetInput::kRefractionCross);
  const double share = along * along / (along * along + cross * cross);
  const double trace = std::pow(at(BudgetInput::kSeaThu) / 2, 2);
  const double sx = std::sin(kDegree * at(BudgetInput::kSeaAxis)), cx = std::cos(kDegree * at(BudgetInput::kSeaAxis));
  Eigen::Matrix2d turned_axes;
  turned_axes << cx, -sx, sx, cx;
  const Eigen::Vector2d in_sea = turned_axes.transpose() * Eigen::Vector2d(ca, sa);
  const Eigen::Matrix2d response = Eigen::Matrix2d::Identity() + (1 / (cw * cw) - 1) * in_sea * in_sea.transpose();
  const Eigen::Vector2d variances(trace * share, trace * (1 - share));
  const Eigen::Vector2d slopes = (response.cwiseAbs2().inverse() * variances).cwiseMax(Eigen::Vector2d::Zero());
  Eigen::Matrix2d on_axes = response * slopes.asDiagonal() * response.transpose();
  on_axes.diagonal() = variances;
  const Eigen::Matrix2d sea = turned_axes * on_axes * turned_axes.transpose();
  c.topLeftCorner<2, 2>() += sea;
  const Eigen::Vector2d with_down = -st / n * cw * (sea * Eigen::Vector2d(ca, sa));
  c(0, 2) += with_down.x();
  c(1, 2) += with_down.y();
  c(2, 2) += std::pow(at(BudgetInput::kSeaTvu) / 2, 2) + options.datum * options.datum;
  thu = 2 * std::sqrt(c(0, 0) + c(1, 1));
  tvu = 2 * std::sqrt(c(2, 2));
}

}  // namespace albtpu::bench
