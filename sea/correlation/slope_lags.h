// The covariance of the slopes of all waves between two points, by the vector between them, and means of its products:
// what errors of second order in slope have in common.
#pragma once

#include <Eigen/Core>

#include "sea/correlation/cell_window.h"
#include "sea/correlation/moving_waves.h"

namespace albtpu {

// Of one sea, at points one time apart. Immutable.
//
// It holds the harmonics over the direction of the lag on the lags of HankelLattice::Shared(). Waves whose phase turns
// within a step of the lattice, by lag or by time, average out. Single precision is enough.
class SlopeLags {
 public:
  static constexpr double kFarthest = 90;  // m

  // `points` are the waves at points; the second point is `later` [s]. Lags reach to `farthest` [m].
  SlopeLags(const FootprintWaves& points, const WaveMotion& motion, double later, double farthest = kFarthest);

  // R_xx, R_xy and R_yy at the vector `lag`, 1 mm to `farthest` long.
  Eigen::Array3d At(const Eigen::Vector2d& lag) const;

  // The means over `density` of products of R_xx, R_xy and R_yy, as MeanOfForms() takes them (slope_covariance.h),
  // where the second of the two footprints lies `apart`. It reaches `farthest` at most.
  Eigen::Matrix3d MeanPairs(const LagDensity& density, const Eigen::Vector2d& apart) const;

 private:
  // About the lag 0, where R changes most: over rings of lags.
  Eigen::Matrix3d PairsOnRings(const LagDensity& density, const Eigen::Vector2d& apart) const;

  bool symmetric_;               // R is the same for the opposite lag
  Eigen::MatrixXd sum_[3];       // of R_xx, R_xy, R_yy: lags, and the real and the imaginary part of each harmonic
  Eigen::MatrixXd on_rings_[3];  // lags, directions
  Eigen::Matrix2Xd directions_;  // unit vectors of a turn, or of half a turn where R is symmetric
};

}  // namespace albtpu
