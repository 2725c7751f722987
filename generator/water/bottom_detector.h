// The time at which a detector finds the bottom in an echo, and how a tilt of the bottom changes it.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "generator/water/echo.h"

namespace albtpu {

// How a detector determines the time from the waveform.
enum class Detector {
  kPeak,      // its maximum
  kHalf,      // where it first reaches half its maximum, plus half the width of the emitted pulse
  kCentroid,  // the centroid between its first and its last crossing of a tenth of its maximum around the peak
};
inline constexpr std::array<Detector, 3> kDetectors = {Detector::kPeak, Detector::kHalf, Detector::kCentroid};
inline constexpr std::array<std::string_view, 3> kDetectorNames = {"peak", "half", "centroid"};
constexpr std::size_t Index(Detector detector) { return static_cast<std::size_t>(detector); }

// In the units of Echo: times of 2 n_group z / c.
struct Detection {
  double time = 0;
  double by_tilt = 0;  // its change for each unit of the bottom's tilt
};

struct DetectedBottom {
  std::array<Detection, 3> by;  // by Detector
  double width = 0;             // of the waveform at half its maximum
};

// `pulse_length` is the full width at half maximum of the emitted Gaussian pulse, at least ten steps of the echo.
// nullopt if the echo has no light, or does not fall below a tenth of its maximum within its times.
std::optional<DetectedBottom> DetectBottom(const Echo& echo, double pulse_length);

// The same without scattering, in closed form, for the Gaussian beam of `setup`.
DetectedBottom ClearBottom(const EchoSetup& setup, double pulse_length);

}  // namespace albtpu
