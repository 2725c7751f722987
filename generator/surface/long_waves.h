// The waves that are longer than the patch under a beam: plane waves, so that no grid has to hold them.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <functional>
#include <vector>

#include "generator/math/random_stream.h"
#include "generator/surface/cross_fade.h"
#include "sea/sea_state.h"

namespace albtpu {

// The part 1 - share(k) of a sea, cut into rings and sectors of the half plane; each cell is one plane wave
// with the cell's variance of elevation and of slope. The sum is exactly Gaussian. Immutable.
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

// Where the line that stands over `at_zero + z * per_height` at height z meets the long waves: the height z
// [m]. The line must be steeper than the waves, which every beam within 60 degrees of nadir is.
double HeightOfIntersection(const LongWaveModel& model, const Eigen::VectorXcd& amplitudes,
                            const Eigen::Vector2d& at_zero, const Eigen::Vector2d& per_height);

}  // namespace albtpu
