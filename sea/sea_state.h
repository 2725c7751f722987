// The sea as a Gaussian random field: its directional elevation spectrum and the moments of that spectrum.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "sea/spectra/wave_spectrum.h"
#include "sea/wave_state.h"

namespace albtpu {

struct SeaOptions {
  WaveState waves;
  // Waves longer than this [m] are left out: the local slope of the surface was measured and the refraction corrected
  // for it.
  double corrected_above = std::numeric_limits<double>::infinity();
  double height_scale = 1;  // factor on the height of every wave
};

// x is downwind, y crosswind. Immutable.
class SeaState {
 public:
  explicit SeaState(const SeaOptions& options);
  SeaState(double wind_speed_10m, double fetch);  // the wind sea of Apel's spectrum, with all its waves

  // Elevation spectrum over all directions, S(k) [m^3]; k [rad/m] above 0.
  double S(double k) const { return k < longest_wave_ ? 0.0 : height_scale_squared_ * (*spectrum_)(k); }

  // (D(k, psi) + D(k, psi + pi)) / 2 [1/rad]: on a frozen surface a wave looks the same as one that travels the
  // opposite way. `psi` [rad] from downwind.
  double FrozenSpreading(double k, double psi) const;

  // The spectrum of a frozen surface, (Psi(k) + Psi(-k)) / 2 with Psi = S(k) D(k, psi) / k [m^4]
  // (Birkebak et al. (2018), Eq. 16 with the Jacobian of polar wavenumbers). Its integral over the plane is
  // the variance of elevation.
  double Psi(double k, double psi) const;

  // The spectrum Psi of the waves that travel towards psi, from which a sea that evolves in time is made.
  // Elfouhaily's model puts the same power into waves with the wind and against it.
  double DirectionalPsi(double k, double psi) const;

  // Integral of weight(k, psi) Psi over the plane: see SlopeCovariance. `Value` is a number or a matrix.
  template <typename Value, typename Weight>
  Value Integral(Value sum, const Weight& weight) const {
    for (const Ring& ring : *rings_) {
      for (int j = 0; j < kDirections; ++j) sum += ring.power[j] * weight(ring.k, (j + 0.5) * kDirectionStep);
    }
    return sum;
  }

  const SeaOptions& options() const { return options_; }
  const WaveSpectrum& spectrum() const { return *spectrum_; }  // of all waves, before height_scale
  WavenumberRange energetic_range() const;                     // of the waves up to corrected_above

 private:
  static constexpr int kDirections = 32;  // of the half plane; Psi is even in k
  static constexpr double kDirectionStep = std::numbers::pi / kDirections;

  // The weights of a quadrature: Psi times the area of the wavenumbers that each node stands for, in both half planes.
  struct Ring {
    double k;
    std::array<double, kDirections> power;  // m^2
  };
  std::vector<Ring> Rings() const;

  SeaOptions options_;
  std::shared_ptr<const WaveSpectrum> spectrum_;
  double longest_wave_;  // rad/m, the wavenumber of `corrected_above`
  double height_scale_squared_;
  std::shared_ptr<const std::vector<Ring>> rings_;
};

// Integral of `weight(k, psi) k_i k_j Psi` over the plane, i and j in {x, y}: the covariance of the two slopes of the
// sea after a filter whose power response is `weight`. With a weight of 1, its trace is the mean square slope.
// Trapezoidal rule in log k (100 steps to a factor of e, finer than any footprint filter varies where it matters) and
// 32 directions of the half plane; the relative error is below 1e-4 if the filter passes at least 3e-5 of the mean
// square slope.
Eigen::Matrix2d SlopeCovariance(const SeaState& sea,
                                const std::function<double(double k, double psi)>& weight);
Eigen::Matrix2d SlopeCovariance(const SeaState& sea);

// Variance of elevation [m^2]; the significant wave height is four times its root.
double ElevationVariance(const SeaState& sea);

}  // namespace albtpu
