// The sea as a Gaussian random field: its directional elevation spectrum and the moments of it.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>

#include "sea/spectra/wave_spectrum.h"

namespace albtpu {

enum class SpectrumKind {
  kApel,        // apel_spectrum.h
  kElfouhaily,  // elfouhaily_spectrum.h
};
std::string_view Name(SpectrumKind spectrum);  // "apel", "elfouhaily"
std::optional<SpectrumKind> FindSpectrum(std::string_view name);

// The shortest fetch [m] at which a spectrum is taken as fully developed.
double FullyDevelopedFetch(SpectrumKind spectrum, double wind_speed_10m);

// The waves of one wind and one fetch.
struct SeaOptions {
  double wind_speed_10m = 0;                               // m/s, above 0
  double fetch = std::numeric_limits<double>::infinity();  // m, above 0; infinity: fully developed
  SpectrumKind spectrum = SpectrumKind::kApel;
  double spreading = 2;  // s of the cosine-2S spreading of Apel's sea; Elfouhaily's has its own
  // Waves longer than this [m] are gone: the surface's local slope was measured and the refraction corrected
  // for it.
  double corrected_above = std::numeric_limits<double>::infinity();
  double height_scale = 1;  // of every wave, over what the spectrum says
};

// x is downwind, y crosswind. Immutable.
class SeaState {
 public:
  explicit SeaState(const SeaOptions& options);
  SeaState(double wind_speed_10m, double fetch);  // Apel's sea, whole

  // Elevation spectrum over all directions, S(k) [m^3]; k [rad/m] above 0.
  double S(double k) const { return k < longest_wave_ ? 0.0 : height_scale_squared_ * (*spectrum_)(k); }

  // (D(k, psi) + D(k, psi + pi)) / 2 [1/rad]: a frozen surface does not tell a wave from the one that travels
  // against it. `psi` [rad] from downwind.
  double FrozenSpreading(double k, double psi) const;

  // The spectrum that a frozen surface sees, (Psi(k) + Psi(-k)) / 2 with Psi = S(k) D(k, psi) / k [m^4]
  // (Birkebak et al. (2018), Eq. 16 with the Jacobian of polar wavenumbers). Its integral over the plane is
  // the variance of elevation.
  double Psi(double k, double psi) const;

  // The spectrum of waves that travel along psi, Psi itself: what a sea that evolves in time is made of.
  // Elfouhaily's does not tell the waves with the wind from those against it.
  double DirectionalPsi(double k, double psi) const;

  const SeaOptions& options() const { return options_; }
  const WaveSpectrum& spectrum() const { return *spectrum_; }  // of the whole sea at its own height
  WavenumberRange energetic_range() const;                     // of what is left of it

 private:
  SeaOptions options_;
  std::shared_ptr<const WaveSpectrum> spectrum_;
  double longest_wave_;  // rad/m, the wavenumber of `corrected_above`
  double height_scale_squared_;
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
