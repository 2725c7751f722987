// The point of which a total states the error, and the spot of which a table does.
//
// A table of the sea surface has the horizontal error of the spot on a level bottom, e_h = x^ - x-, both at the true
// depth d below the water, and the vertical error e_z = d - r- cos r, up (docs/physics.md, section 1). What processing
// reports is the point at the measured range r- along the ray of still water: r- cos r below the water, and r- sin r
// along the beam b. Its horizontal error is
//     e_h + (r- sin r - d tan r) b = e_h - tan r e_z b,
// so that with D = -e_z, down, the error of the point is J times that of the spot, J = I + tan r (b, 0) (0, 0, 1)^T. A
// ray that is deflected outwards makes a longer path: the point is reported farther out by sin^2 r of the error.
#pragma once

#include <cmath>
#include <numbers>

namespace albtpu {

// The mean error along the beam of the reported point, m, from the means of the spot: along the beam, and vertical, up.
// A vertical bias that is not known counts as none. `incidence` in degrees, in air.
inline float ReportedBiasAlong(float along, float vertical, double incidence, double index) {
  if (std::isnan(vertical)) return along;
  const double sine = std::sin(incidence * (std::numbers::pi / 180)) / index;
  return static_cast<float>(along - sine / std::sqrt(1 - sine * sine) * vertical);
}

// The mean error of a point, m, from that by the sea, which not every table states, and that by the water below it.
// What is not known of the sea counts as none beside the water, as it does in orders.
inline float BiasInWater(float sea, float water) { return (std::isnan(sea) ? 0 : sea) + water; }

}  // namespace albtpu
