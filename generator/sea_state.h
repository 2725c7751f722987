// The sea as a Gaussian random field: its directional elevation spectrum and the moments of it.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "generator/spreading.h"
#include "generator/wave_spectrum.h"

namespace albtpu {

// Waves of one wind and one fetch. x is downwind, y crosswind.
class SeaState {
 public:
  // wind_speed_10m [m/s] and fetch [m] above 0; a fetch of infinity is the fully developed sea.
  SeaState(double wind_speed_10m, double fetch, Cosine2sSpreading spreading = Cosine2sSpreading());

  // The spectrum that a frozen surface sees, (Psi(k) + Psi(-k)) / 2 with Psi = S(k) D(psi) / k [m^4]
  // (Birkebak et al. (2018), Eq. 16 with the Jacobian of polar wavenumbers). Its integral over the plane is
  // the variance of elevation. `k` [rad/m] is the magnitude, above 0, `psi` [rad] the direction.
  double Psi(double k, double psi) const;
  double FrozenSpreading(double psi) const;  // (D(psi) + D(psi + pi)) / 2, 1/rad

  // The spectrum of waves that travel along psi, Psi itself: what a sea that evolves in time is made of.
  double DirectionalPsi(double k, double psi) const;

  const ApelSpectrum& spectrum() const { return spectrum_; }
  WavenumberRange energetic_range() const { return EnergeticRange(spectrum_); }

 private:
  ApelSpectrum spectrum_;
  Cosine2sSpreading spreading_;
};

// Integral of `weight(k, psi) k_i k_j Psi` over the plane, i and j in {x, y}: the covariance of the two
// slopes of the sea as a filter of power `weight` lets it through. With a weight of 1, its trace is the mean
// square slope. Trapezoids in log k (50 a factor of e, finer than any footprint filter varies where it
// matters) and 32 directions of the half plane; relative error below 1e-4 where the filter lets 3e-5 of the
// mean square slope through.
Eigen::Matrix2d SlopeCovariance(const SeaState& sea,
                                const std::function<double(double k, double psi)>& weight);
Eigen::Matrix2d SlopeCovariance(const SeaState& sea);

// Variance of elevation [m^2]; the significant wave height is four times its root.
double ElevationVariance(const SeaState& sea);

}  // namespace albtpu
