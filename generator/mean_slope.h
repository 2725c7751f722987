// The slope of a surface averaged over a beam, as the rays would meet it were the water's height not to shift them:
// linear in the heights, so that its statistics are known exactly. It is what a beam's refraction follows, and the
// control variate of the Monte Carlo.
#pragma once

#include <Eigen/Core>
#include <array>

#include "generator/beam.h"
#include "generator/sea_surface.h"

namespace albtpu {

// Immutable.
class MeanSlope {
 public:
  // Of a collimated beam's `rays` on surfaces of `model`, about the axis that meets the water at the centre of
  // the window.
  MeanSlope(const SurfaceModel& model, const Beam& beam, const std::vector<Ray>& rays);

  Eigen::Vector2d operator()(const HeightField& window) const;

  // Over all surfaces.
  const Eigen::Vector2d& mean() const { return moments_.mean; }
  const Eigen::Matrix2d& covariance() const { return moments_.covariance; }

 private:
  int first_, count_;                       // the rows and columns of the window that the beam reaches
  std::array<Eigen::MatrixXd, 2> weights_;  // of their heights, for the slopes along x and y; iy is the row
  SurfaceModel::Moments moments_;
};

}  // namespace albtpu
