#include "sea/response/beam_response.h"

#include <algorithm>
#include <cmath>

namespace albtpu {

// The tangent t of the deviation is normal with the mean b and the variance K. To third order atan t = t - t^3 / 3, and
// the covariance of t and t^3 is 3 K^2 + 3 b^2 K: the variance of the angle is K (1 - 2 K - 2 b^2).
// Rounding may leave a negative K across long-crested waves, as in THU and TVU.
double BeamResponse::Refraction(int axis) const {
  const double k = std::max(0.0, covariance_per_depth(axis, axis)), b = mean_per_depth[axis];
  return 2 * std::sqrt(k) * (1 - k - b * b);
}

double BeamResponse::Thu(double depth) const {
  return 2 * std::sqrt(std::max(0.0, Covariance(depth).topLeftCorner<2, 2>().trace()));
}

double BeamResponse::Tvu(double depth) const { return 2 * std::sqrt(std::max(0.0, Covariance(depth)(2, 2))); }

}  // namespace albtpu
