// A laser pulse and its uncertainty.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "tables/schema.h"

namespace albtpu {

// A laser pulse, in the units of the axes. Single precision, like the wire format and the nodes, so that a query at 0.1
// m hits the node 0.1 m through every interface.
struct Pulse {
  float wind_speed = 0;  // m/s at 10 m; no effect in a table of one sea
  float fetch =
      std::numeric_limits<float>::infinity();  // m; infinity: a fully developed sea; no effect in a table of one sea
  float incidence = 0;                         // degree from the vertical, in air
  // Degree from downwind; absent: the worse of 0 and 90 degrees. In a table of one sea, from its x axis towards its y
  // axis; absent: the worst node.
  std::optional<float> azimuth = {};
  float footprint = 0;  // m
  float depth = 0;      // m below the located surface
};

enum class Outcome {
  kInterpolated,  // The numbers are valid.
  kOutOfDomain,   // The pulse is outside the nodes of an axis. There are no numbers: nothing is extrapolated.
  kInvalid,       // A coordinate is not finite (except a fetch of +infinity). There are no numbers.
};

// The side of a coordinate outside the nodes of its axis: below the first one, or above the last.
enum class Side { kBelow, kAbove };
std::string_view Name(Side side);  // "below", "above"

// The side of `coordinate`, which is outside the nodes of `axis`, the last of which is `last`. None on a folded axis:
// an azimuth is on no side of the folded nodes. Coordinates compare as in Axis::Locate.
std::optional<Side> SideOf(const AxisSchema& axis, double last, double coordinate);

// At 2 sigma, as in the table; see coverage.h for 95 %. NaN wherever there is no number.
struct PulseUncertainty {
  Outcome outcome = Outcome::kInvalid;
  // The first axis, in the order of kAxes, that caused the outcome; none if interpolated.
  std::optional<AxisId> axis;
  // If true, each value is the largest in magnitude of those at 0 and 90 degrees, or, in a table of one sea, at all
  // azimuth nodes.
  bool azimuth_absent = false;
  std::array<float, kQuantityCount> values;
  std::array<float, kQuantityCount> standard_errors;  // Interpolated linearly.
  // The ratio of the 95 % radius of the horizontal error to the THU, for coverage.h. Without an azimuth it cannot be
  // computed from the values: the radius, too, is the largest of those at the azimuths.
  double radius_over_thu = 1;
  std::optional<Side> side;  // On which side of `axis` the pulse is, if it is out of domain: SideOf.

  float operator[](Quantity quantity) const { return values[Index(quantity)]; }
};

// "INTERPOLATED", "OUT_OF_DOMAIN:depth:above", "INVALID": the text in CSV files and for people.
std::string OutcomeText(const PulseUncertainty& uncertainty);

}  // namespace albtpu
