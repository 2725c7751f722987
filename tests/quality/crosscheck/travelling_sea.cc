#include "tests/quality/crosscheck/travelling_sea.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sea/correlation/moving_waves.h"
#include "sea/response/closed_form.h"
#include "sea/sea_state.h"

namespace albtpu::testing {

quality::SeaOfSource SeaOfWind(double wind_speed) {
  const WindSea waves{.wind_speed_10m = wind_speed, .model = &kElfouhailyModel};
  return {.spectrum = Sampled(*waves.MakeSpectrum(), SeaWavenumbers(), kSeaHarmonics),
          .x_azimuth = std::numbers::pi / 2,
          .water_index = 1.34};
}

Eigen::Matrix2d SlopesUnderFootprint(double wind_speed) {
  return MovingWaves(SeaOfWind(wind_speed).spectrum).Under({.footprint = kSeaFootprint}).Whole().slopes;
}

double SigmaOfHeights(double wind_speed) {
  const FootprintWaves waves = MovingWaves(SeaOfWind(wind_speed).spectrum).Under({.footprint = kSeaFootprint});
  return std::sqrt(waves.Whole().heights);
}

TravellingSea::TravellingSea(double wind_speed, RandomNumbers& random) {
  constexpr double kLongest = 0.05, kShortest = 40;  // rad/m: the footprint hides what is shorter.
  constexpr std::size_t kStep = 3;                   // Samples of the spectrum, 15 % in all.
  constexpr int kDirections = 12;
  const HarmonicSpectrum sea = SeaOfWind(wind_speed).spectrum;
  std::vector<float> columns[5];
  for (std::size_t i = 0; i + kStep < sea.size(); i += kStep) {
    const double from = sea.k[i], to = sea.k[i + kStep];
    const std::size_t middle = i + kStep / 2;
    if (from < kLongest || to > kShortest) continue;
    double energy = 0;
    for (std::size_t j = i; j < i + kStep; ++j) energy += (sea.s[j] + sea.s[j + 1]) / 2 * (sea.k[j + 1] - sea.k[j]);
    for (int j = 0; j < kDirections; ++j) {
      const double k = from * std::pow(to / from, random.Uniform(0, 1));
      const double psi = 2 * std::numbers::pi * (j + random.Uniform(0, 1)) / kDirections, c = std::cos(psi);
      double spread = 1;
      for (std::size_t n = 0; n < sea.harmonics(); ++n)
        spread +=
            2 * (sea.a[n][middle] * std::cos(2 * (n + 1.0) * psi) + sea.b[n][middle] * std::sin(2 * (n + 1.0) * psi));
      // They travel downwind, as WaveTravel::kOneWay says.
      spread *= 1 + 2 * c / (1 + c * c);
      const double height = std::sqrt(2 * energy / kDirections * std::max(spread, 0.0)) *
                            FootprintAverage({.footprint = kSeaFootprint}, k, psi);
      const double of_wave[] = {k * c, k * std::sin(psi), std::sqrt(9.81 * k * (1 + std::pow(k / 370, 2))),
                                random.Uniform(0, 2 * std::numbers::pi), height};
      for (std::size_t column = 0; column < 5; ++column) columns[column].push_back(static_cast<float>(of_wave[column]));
    }
  }
  Eigen::ArrayXf* const arrays[] = {&kx_, &ky_, &omega_, &phase_, &height_};
  for (std::size_t column = 0; column < 5; ++column)
    *arrays[column] =
        Eigen::Map<const Eigen::ArrayXf>(columns[column].data(), static_cast<Eigen::Index>(columns[column].size()));
}

TravellingSea::Water TravellingSea::At(double x, double y, double time) const {
  const auto east = static_cast<float>(x), north = static_cast<float>(y), t = static_cast<float>(time);
  const Eigen::ArrayXf phase = kx_ * east + ky_ * north - omega_ * t + phase_, steep = -height_ * phase.sin();
  return {.slope = {(kx_ * steep).sum(), (ky_ * steep).sum()}, .height = (height_ * phase.cos()).sum()};
}

}  // namespace albtpu::testing
