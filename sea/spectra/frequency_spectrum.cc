#include "sea/spectra/frequency_spectrum.h"

#include <algorithm>
#include <cmath>

#include "sea/spectra/spectrum_moments.h"

namespace albtpu {

DirectionalEnergy& DirectionalEnergy::Add(const DirectionalEnergy& other, double weight) {
  energy += weight * other.energy;
  for (std::size_t n = 0; n < kSeaHarmonics; ++n) {
    cosine[n] += weight * other.cosine[n];
    sine[n] += weight * other.sine[n];
  }
  return *this;
}

bool DirectionalEnergy::IsIsotropic() const {
  constexpr double kRounding = 1e-9;
  return std::hypot(cosine[0], sine[0]) <= kRounding * energy;
}

double DirectionalEnergy::PrincipalAxis() const { return 0.5 * std::atan2(sine[0], cosine[0]); }

DirectionalEnergy SymmetricEnergy(double energy, const std::array<double, kSeaHarmonics>& means, double axis) {
  DirectionalEnergy result{.energy = energy};
  for (std::size_t n = 0; n < kSeaHarmonics; ++n) {
    const double angle = 2 * static_cast<double>(n + 1) * axis;
    result.cosine[n] = energy * means[n] * std::cos(angle);
    result.sine[n] = energy * means[n] * std::sin(angle);
  }
  return result;
}

HarmonicSpectrum ByWavenumber(const FrequencySpectrum& spectrum, double depth, double x_azimuth,
                              const std::vector<double>& wavenumbers) {
  HarmonicSpectrum result = FlatSea(wavenumbers, kSeaHarmonics);
  for (std::size_t i = 0; i < wavenumbers.size(); ++i) {
    const double k = wavenumbers[i];
    const auto frequency = [&](std::size_t of) { return FrequencyOfWavenumber(wavenumbers[of], depth); };
    const DirectionalEnergy at_f = spectrum.Between(frequency(i == 0 ? i : i - 1), frequency(i),
                                                    frequency(std::min(i + 1, wavenumbers.size() - 1)));
    if (!(at_f.energy > 0)) continue;
    result.s[i] = at_f.energy * FrequencySlope(k, depth);
    // psi = x_azimuth - c, because a compass turns clockwise.
    for (std::size_t n = 0; n < kSeaHarmonics; ++n) {
      const double angle = 2 * static_cast<double>(n + 1) * x_azimuth;
      const double cosine = at_f.cosine[n] / at_f.energy, sine = at_f.sine[n] / at_f.energy;
      result.a[n][i] = std::cos(angle) * cosine + std::sin(angle) * sine;
      result.b[n][i] = std::sin(angle) * cosine - std::cos(angle) * sine;
    }
  }
  return result;
}

}  // namespace albtpu
