// Described seas of which tests compile tables.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sea/angle.h"
#include "sea/spectra/described_sea.h"
#include "sea/spectra/jonswap.h"

namespace albtpu {

struct NamedSea {
  std::string name;
  SeaDescription sea;
};

inline JonswapWaves Waves(double height, double period, double towards, std::optional<double> spread = {},
                          double gamma = 3.3) {
  return {.significant_wave_height = height,
          .peak_period = period,
          .gamma = gamma,
          .travels_towards = RadiansOfDegrees(towards),
          .spread = spread ? std::optional(RadiansOfDegrees(*spread)) : std::nullopt};
}

// Wind from the south: x points north.
inline SeaDescription SeaOf(double wind_speed, std::vector<JonswapWaves> waves = {}, std::optional<double> depth = {}) {
  SeaDescription sea{.wind_speed_10m = wind_speed, .wind_from = RadiansOfDegrees(180), .water_depth = depth};
  if (!waves.empty()) {
    sea.waves =
        std::make_shared<JonswapSpectrum>(std::move(waves), depth.value_or(std::numeric_limits<double>::infinity()));
  }
  return sea;
}

// What a survey may meet, and harder: crossing swell, a narrow swell in a calm, a young sea, shallow water.
inline std::vector<NamedSea> TableSeas() {
  return {{"wind of 3 m/s", SeaOf(3)},
          {"wind of 7 m/s", SeaOf(7)},
          {"wind of 15 m/s", SeaOf(15)},
          {"young sea", SeaOf(8, {Waves(0.3, 1.8, 10)})},
          {"swell crossing by 60 degrees", SeaOf(5, {Waves(0.5, 3.2, 0), Waves(1.2, 9, 60, 15, 7)})},
          {"steep swell crossing by 120 degrees", SeaOf(3, {Waves(0.3, 2.5, 20), Waves(1.5, 5.5, 120, 20, 5)})},
          {"narrow swell in a calm", SeaOf(0, {Waves(2, 9, 30, 10, 10)})},
          {"waves in 5 m of water", SeaOf(9, {Waves(0.8, 4.5, -30)}, 5)}};
}

}  // namespace albtpu
