// The sea as a Gaussian random field: the description of its waves, its directional elevation spectrum and the moments
// of that spectrum.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <string_view>
#include <variant>
#include <vector>

#include "sea/spectra/apel_spectrum.h"
#include "sea/spectra/elfouhaily_spectrum.h"
#include "sea/spectra/wave_spectrum.h"
#include "sea/spectra/wind_sea.h"

namespace albtpu {

// A sea without waves.

// S(k) = 0. Wavenumbers and directions have no meaning; they are such that every computation with them is defined.
class CalmSpectrum final : public WaveSpectrum {
 public:
  double operator()(double) const override { return 0; }
  double Spreading(double, double) const override { return 1 / (2 * std::numbers::pi); }
  bool spreading_varies_with_wavenumber() const override { return false; }
  double peak_wavenumber() const override { return 1; }
  WavenumberRange energetic_range() const override { return {1, 1000}; }
  std::string name() const override { return "no waves"; }
  std::string reference() const override { return "none: a calm"; }
  std::string departures() const override { return "A calm has no waves; measured seas keep their swell."; }
};

// A description of the waves, and the spectrum that follows from it.

// Every spectrum model of the wind sea. A model is added by its own file in sea/spectra and an entry here.
inline constexpr std::array kSpectrumModels = {&kApelModel, &kElfouhailyModel};

// The keys of these models, in campaign files and on the command line.
inline constexpr std::array kSpectrumKeys = [] {
  std::array<std::string_view, kSpectrumModels.size()> keys;
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = kSpectrumModels[i]->key;
  return keys;
}();

// The listed model with this key; null if there is none.
const SpectrumModel* FindSpectrumModel(std::string_view key);

// The listed model whose author's name begins that of a spectrum, as tables state it ("Apel (1994) with ..."); that of
// Elfouhaily if no name does.
const SpectrumModel& SpectrumModelNamed(std::string_view spectrum);

// The waves that one steady wind raises over one fetch. A wind of 0 raises none.
struct WindSea {
  double wind_speed_10m = 0;                 // m/s, from 0
  double fetch = kFullyDeveloped;            // m, above 0
  const SpectrumModel* model = &kApelModel;  // not null; it need not be a listed one
  double spreading = 2;                      // s of the cosine-2S spreading; ignored by models that have their own

  std::shared_ptr<const WaveSpectrum> MakeSpectrum() const;
};

// Waves of which the spectrum itself is known: measured, computed by a model or described (sampled_spectrum.h). Then x
// and y are the axes of its own frame.
struct KnownWaves {
  std::shared_ptr<const WaveSpectrum> spectrum;  // not null

  std::shared_ptr<const WaveSpectrum> MakeSpectrum() const { return spectrum; }
};

// Another kind of description is another alternative with a MakeSpectrum().
using WaveState = std::variant<WindSea, KnownWaves>;

std::shared_ptr<const WaveSpectrum> MakeSpectrum(const WaveState& waves);

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
    for (const Ring& ring : *rings_)
      for (int j = 0; j < kDirections; ++j) sum += ring.power[j] * weight(ring.k, (j + 0.5) * kDirectionStep);
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
Eigen::Matrix2d SlopeCovariance(const SeaState& sea, const std::function<double(double k, double psi)>& weight);
Eigen::Matrix2d SlopeCovariance(const SeaState& sea);

// Variance of elevation [m^2]; the significant wave height is four times its root.
double ElevationVariance(const SeaState& sea);

}  // namespace albtpu
