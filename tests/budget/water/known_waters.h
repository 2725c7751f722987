// Waters for tests of the server and its client.
#pragma once

#include <cstddef>
#include <vector>

#include "budget/water/known_water.h"

namespace albtpu::testing {

inline KnownWater CoastalWater(const OpticsInput& optics = {.kd = 0.15, .kd_kind = KdKind::kDiffuse532}) {
  return {.optics = optics,
          .detector = EchoDetector::kHalf,
          .field_of_view = 6,
          .pulse_length = 1.5,
          .bias = BiasTreatment{.handling = BiasHandling::kCorrect}};
}

// Each way to say how clear the water is, each detector, each treatment, and each of what else a water may have.
inline std::vector<KnownWater> WatersOfAllKinds() {
  std::vector<KnownWater> waters;
  for (std::size_t kind = 0; kind < kKdKindNames.size(); ++kind)
    waters.push_back(CoastalWater({.kd = 0.17, .kd_kind = static_cast<KdKind>(kind)}));
  waters.push_back(CoastalWater({.secchi = 4.3}));
  for (const std::string_view type : kJerlovTypes)
    if (type > "1") waters.push_back(CoastalWater({.jerlov = type}));
  waters.push_back(CoastalWater({.absorption = 0.11, .scattering = 0.43, .kd_sigma = 0.013}));
  waters.push_back(CoastalWater({.secchi = 6, .omega0 = 0.77, .omega0_sigma = 0.07, .backscatter_fraction = 0.017}));
  for (std::size_t detector = 0; detector < kEchoDetectorNames.size(); ++detector) {
    for (std::size_t handling = 0; handling < kBiasHandlingNames.size(); ++handling) {
      KnownWater water = CoastalWater();
      water.detector = static_cast<EchoDetector>(detector);
      water.bias = BiasTreatment{.handling = static_cast<BiasHandling>(handling)};
      if (water.bias->handling == BiasHandling::kVendor) water.bias->residual_fraction = 0.3;
      if (water.bias->handling == BiasHandling::kCalibrated) {
        if (water.detector != EchoDetector::kPeak) continue;  // Elsewhere the waters disagree on the sign.
        water.bias->calibration_depth = 5;
        water.bias->calibration_offset = -0.04;
        water.bias->calibration_sigma = 0.01;
      }
      waters.push_back(water);
    }
  }
  KnownWater counted = CoastalWater();
  counted.photons = 137;
  waters.push_back(counted);
  KnownWater cold = counted;
  cold.temperature = 4.5;
  cold.salinity = 31;
  cold.processed_with = 1.33;
  waters.push_back(cold);
  cold.green_surface = true;
  waters.push_back(cold);
  cold.field_of_view = 3;  // Cuts many beams.
  cold.bias->handling = BiasHandling::kNone;
  waters.push_back(cold);
  cold.bias.reset();
  cold.photons.reset();
  waters.push_back(cold);
  cold.green_surface = false;
  waters.push_back(cold);
  return waters;
}

}  // namespace albtpu::testing
