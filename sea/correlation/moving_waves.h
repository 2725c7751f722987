// The waves of a sea as they travel: the covariance of slopes and heights, averaged over a footprint, between two
// places and two times, and of their means over a cell.
#pragma once

#include <Eigen/Core>
#include <utility>

#include "sea/correlation/correlation.h"
#include "sea/response/closed_form.h"
#include "sea/spectra/harmonic_spectrum.h"

namespace albtpu {

// Of slopes (x and y) and heights [m^2] at two points or of two means.
struct WaveCovariance {
  Eigen::Matrix2d slopes;
  double heights;
};

// Harmonics over directions of the waves on HankelLattice::Shared(): with F the slope variance in a step of ln k and
// d(psi), the factors of exp(i n psi), n from 0 to kLast, in F, F cos(2 psi) and F sin(2 psi) at all wavenumbers. Those
// of -n are the conjugates.
class WaveHarmonics {
 public:
  static constexpr int kLast = 19;

  // `factors` of F: wavenumbers, and n from 0 to kLast + 2.
  explicit WaveHarmonics(Eigen::MatrixXcd factors) : factors_(std::move(factors)) {}

  auto sum(int n) const { return factors_.col(n).array(); }
  Eigen::ArrayXcd cosine(int n) const;
  Eigen::ArrayXcd sine(int n) const;

 private:
  Eigen::MatrixXcd factors_;
};

// What FootprintWaves::Between() is at one distance and time, in all directions.
class WavesAtDistance {
 public:
  // `direction` of the way from one place to the other, anticlockwise from x [rad].
  WaveCovariance Towards(double direction) const;

 private:
  friend class FootprintWaves;
  // By n, the factors of exp(i n direction), whose real part counts: real and imaginary of F, of F cos(2 psi) and of
  // F sin(2 psi), and of the heights.
  Eigen::Array<double, WaveHarmonics::kLast + 1, 8> factors_ =
      Eigen::Array<double, WaveHarmonics::kLast + 1, 8>::Zero();
};

// The waves of one sea under the footprint of one beam. Immutable.
class FootprintWaves {
 public:
  FootprintWaves(WaveHarmonics harmonics, const WaveMotion& motion)
      : harmonics_(std::move(harmonics)), motion_(motion) {}

  // Between a footprint and one whose centre lies `apart` [m] from it on the water, `later` [s]:
  //     integral of Psi k k^T W^2 cos(k . apart - omega later) dk, and with Psi W^2 for the heights.
  // A tenth of a millisecond, in which AtDistance() finds it in all directions.
  WaveCovariance Between(const Eigen::Vector2d& apart, double later) const;
  WavesAtDistance AtDistance(double distance, double later) const;

  // Of one footprint with itself.
  WaveCovariance Whole() const;

  // The variance of the mean over the cell, at one instant: the mean of Between() over all pairs of its points, the
  // integral of Psi k k^T W^2 W_a^2 dk with W_a = sinc(k_x a / 2) sinc(k_y a / 2) on the axes of the cell.
  WaveCovariance InCell(const SurfaceCell& cell) const;

  const WaveHarmonics& harmonics() const { return harmonics_; }

 private:
  WaveHarmonics harmonics_;
  WaveMotion motion_;
};

// One sea. Immutable.
class MovingWaves {
 public:
  explicit MovingWaves(const HarmonicSpectrum& spectrum, const WaveMotion& motion = {});

  // All waves, at points.
  FootprintWaves AtPoints() const;

  // Averaged over the footprint of `beam`, 0.01 to 10 m wide.
  FootprintWaves Under(const BeamOptions& beam) const;

  const WaveMotion& motion() const { return motion_; }

 private:
  // The harmonics of the waves times `weights` at kDirections directions of the half plane; one column for all
  // directions, or one for each.
  static constexpr int kDirections = 24;
  WaveHarmonics Weighted(const Eigen::MatrixXd& weights) const;

  WaveMotion motion_;
  Eigen::MatrixXd power_;  // F, wavenumber and direction of the half plane
};

}  // namespace albtpu
