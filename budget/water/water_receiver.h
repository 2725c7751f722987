// How a survey's receiver sees the water column, and what its processing did about the bias.
#pragma once

#include <array>
#include <string_view>

#include "sea/water_index.h"

namespace albtpu {

// How the receiver determines the time of an echo.
enum class EchoDetector { kPeak, kHalf, kCentroid };
inline constexpr std::array<std::string_view, 3> kEchoDetectorNames = {"peak", "half", "centroid"};

struct WaterReceiver {
  EchoDetector detector = EchoDetector::kPeak;
  double field_of_view = 0;  // m, diameter on the surface, across the beam; infinity: all
  double pulse_length = 0;   // ns, full width at half maximum
  double group_index = kSeaWaterGroupIndex;
};

// How the processing of the survey corrected the bias.
enum class BiasHandling {
  kNone,       // Not at all.
  kCorrect,    // By the mean bias of this table.
  kVendor,     // By a method of the vendor that leaves a fraction of the bias.
  kCalibrated  // By the mean bias of this table, scaled to a measured bias.
};
inline constexpr std::array<std::string_view, 4> kBiasHandlingNames = {"none", "correct", "vendor", "calibrated"};

struct BiasTreatment {
  BiasHandling handling = BiasHandling::kNone;
  double residual_fraction = 0;  // kVendor: 0 to 1
  // kCalibrated: the vertical bias measured at one depth, positive if too shallow, and its standard deviation. m.
  double calibration_depth = 0, calibration_offset = 0, calibration_sigma = 0;
};

}  // namespace albtpu
