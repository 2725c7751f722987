// The waves that are longer than the patch under a beam, as plane waves, which need no grid.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <functional>
#include <vector>

#include "generator/math/random_stream.h"
#include "generator/surface/wave_patch.h"
#include "sea/sea_state.h"

namespace albtpu {

// The part 1 - share(k) of a sea's spectrum, divided into rings and sectors of the half plane. Each cell becomes one
// plane wave with the cell's variances of elevation and slope and Gaussian amplitudes, so the sum is exactly Gaussian.
// Immutable.
class LongWaveModel {
 public:
  struct Wave {
    Eigen::Vector2d wavenumber;  // rad/m
    double variance;             // m^2
  };

  LongWaveModel(const SeaState& sea, const CrossFade& patch_share);

  const std::vector<Wave>& waves() const { return waves_; }
  double elevation_variance() const;
  Eigen::Matrix2d SlopeCovariance(const std::function<double(double k, double psi)>& weight) const;

  // Complex amplitudes A [m]: the elevation at x is the real part of the sum of A exp(i k . x).
  Eigen::VectorXcd Draw(NormalStream& stream) const;

  // The amplitudes of the same waves about another origin.
  Eigen::VectorXcd Shifted(const Eigen::VectorXcd& amplitudes, const Eigen::Vector2d& origin) const;

 private:
  std::vector<Wave> waves_;
};

// The sum of plane waves on a grid: the real part of phases_x diag(amplitudes) phases_y^T. The columns of `phases_x`
// are exp(i k_x x) of each wave at the grid's x (rows of the result), those of `phases_y` exp(i k_y y) (columns).
Eigen::MatrixXd SumOfWaves(const Eigen::MatrixXcd& phases_x, const Eigen::VectorXcd& amplitudes,
                           const Eigen::MatrixXcd& phases_y);

// The height z [m] at which the line through `at_zero + z * per_height` intersects the long waves. The line must be
// steeper than the waves, as every beam within 60 degrees of nadir is.
double HeightOfIntersection(const LongWaveModel& model, const Eigen::VectorXcd& amplitudes,
                            const Eigen::Vector2d& at_zero, const Eigen::Vector2d& per_height);

}  // namespace albtpu
