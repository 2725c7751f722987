// One laser pulse, and its uncertainty.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>

#include "tables/schema.h"

namespace albtpu {

// One laser pulse, in the units of the axes. Single precision, as on the wire and on the nodes: 0.1 m asked
// for is the node 0.1 m, on every path.
struct Pulse {
  float wind_speed = 0;                                  // m/s at 10 m
  float fetch = std::numeric_limits<float>::infinity();  // m; infinity: fully developed
  float incidence = 0;                                   // degree from the vertical, in air
  std::optional<float> azimuth;  // degree from downwind; absent: the worse of 0 and 90
  float footprint = 0;           // m
  float depth = 0;               // m below the located surface
};

enum class Outcome {
  kInterpolated,  // Numbers stand.
  kOutOfDomain,   // An axis does not reach the pulse; no number is invented.
  kInvalid,       // A coordinate is not finite (a fetch of +infinity aside); no number.
};

// 2 sigma, as the table holds it; see coverage.h for 95 %. Not-a-number wherever there is no number.
struct PulseUncertainty {
  Outcome outcome = Outcome::kInvalid;
  // The first axis, in the order of kAxes, that made the outcome; none if interpolated.
  std::optional<AxisId> axis;
  bool azimuth_absent = false;  // True: each value is the larger in magnitude of those at 0 and 90 degrees.
  std::array<float, kQuantityCount> values;
  std::array<float, kQuantityCount> standard_errors;  // Interpolated linearly.
  // The 95 % radius of the horizontal error over the THU, for coverage.h. Without an azimuth the values do
  // not tell it: the radius, too, is the larger of those at 0 and 90 degrees.
  double radius_over_thu = 1;

  float operator[](Quantity quantity) const { return values[Index(quantity)]; }
};

// "INTERPOLATED", "OUT_OF_DOMAIN:depth", "INVALID": the text of CSV files and of people.
std::string OutcomeText(const PulseUncertainty& uncertainty);

}  // namespace albtpu
