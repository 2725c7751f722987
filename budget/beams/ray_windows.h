// The point at which the rays of a few seconds meet, without a start value.
#pragma once

#include <optional>
#include <span>

#include "budget/beams/return_pair.h"
#include "budget/beams/track_spline.h"

namespace albtpu {

// The position at `time` and the velocity of a sensor in straight motion that is nearest to the lines of `rays`: the
// solution of
//     sum of w Q (X0 + V (t - time) - S) = 0,    Q = I - u u',
// 6 linear equations, solved again eight times with w = 1 / (1 + (e / s)^2), e the distances from the lines and s their
// median. None when the rays do not determine it. It puts the sensor too low where directions have errors: a lower one
// is nearer to lines that scatter by angles. It is a start for angles.
std::optional<KnotState> WhereRaysMeet(std::span<const AirRay> rays, double time);

}  // namespace albtpu
