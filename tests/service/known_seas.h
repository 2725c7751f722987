// Seas of every form that a query may carry.
#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "service/seas/known_sea.h"

namespace albtpu::testing {

// A wind sea and swell that crosses it, in shallow water.
inline KnownSea DescribedWaves() {
  return {.waves = std::make_shared<const std::vector<JonswapWaves>>(std::vector<JonswapWaves>{
              {.significant_wave_height = 0.42, .peak_period = 2.7, .travels_towards = 0.8},
              {.significant_wave_height = 1.1, .peak_period = 9.5, .gamma = 7, .travels_towards = 2.1, .spread = 0.3}}),
          .wind_speed_10m = 6.5,
          .wind_from = 3.9,
          .water_depth = 12.0};
}

// A buoy's spectrum with the second harmonic, measured over 20 minutes, and no wind.
inline KnownSea MeasuredWaves() {
  auto frequencies = std::make_shared<std::vector<double>>();
  std::vector<DirectionalEnergy> bins;
  for (double f = 0.05; f < 0.48; f += 0.01) {
    frequencies->push_back(f);
    const double energy = 0.02 * std::pow(f, -3) * std::exp(-1.25 * std::pow(0.12 / f, 4));
    bins.push_back(SymmetricEnergy(energy, {0.4 + 0.2 * f}, 1.1 + f));
  }
  return {.waves = std::make_shared<const BinnedSpectrum>(frequencies, bins, 1, 0.4),
          .tail = TailRule::kLevel,
          .tail_from = 0.35,
          .record_length = 1200};
}

// The spectrum of a model with all harmonics.
inline KnownSea ModelledWaves() {
  auto frequencies = std::make_shared<std::vector<double>>();
  std::vector<DirectionalEnergy> bins;
  std::mt19937 random(3);
  for (double f = 0.04; f < 0.6; f *= 1.1) {
    frequencies->push_back(f);
    DirectionalEnergy& bin = bins.emplace_back();
    bin.energy = 0.2 + static_cast<double>(random() % 1000) / 1000;
    for (std::size_t n = 0; n < kSeaHarmonics; ++n) {
      bin.cosine[n] = 0.1 * static_cast<double>(random() % 1000) / 1000;
      bin.sine[n] = -0.1 * static_cast<double>(random() % 1000) / 1000;
    }
  }
  return {.waves = std::make_shared<const BinnedSpectrum>(frequencies, bins, kSeaHarmonics, 0.5),
          .wind_speed_10m = 4.0,
          .wind_from = -1.0,
          .tail = TailRule::kWind};
}

// A complete spectrum over wavenumber.
inline KnownSea CompleteSea() {
  HarmonicSpectrum sea;
  for (double k = 0.02; k < 300; k *= 1.2) {
    sea.k.push_back(k);
    sea.s.push_back(0.004 * std::pow(k + 0.1, -3));
  }
  sea.a = {std::vector<double>(sea.k.size(), 0.3), std::vector<double>(sea.k.size(), 0.05)};
  sea.b = {std::vector<double>(sea.k.size(), -0.2), std::vector<double>(sea.k.size(), 0.01)};
  return {.waves = std::make_shared<const HarmonicSpectrum>(std::move(sea)), .wind_from = 1.0};
}

inline std::vector<KnownSea> SeasOfAllForms() {
  return {DescribedWaves(),
          MeasuredWaves(),
          ModelledWaves(),
          CompleteSea(),
          {.wind_speed_10m = 8.0, .wind_from = 0.5},
          {.wind_speed_10m = 0.0}};
}

// A wind sea that no other number makes.
inline KnownSea WindSea(double wind_speed) { return {.wind_speed_10m = wind_speed, .wind_from = 0.0}; }

}  // namespace albtpu::testing
