#include "sea/response/closed_form.h"

#include <cmath>

#include "sea/response/refraction.h"

namespace albtpu {

SmallSlopeUncertainty ClosedForm(const SeaState& sea, const BeamOptions& beam, double refractive_index) {
  const Eigen::Matrix2d slopes =
      SlopeCovariance(sea, [&](double k, double psi) { return FootprintPower(beam, k, psi); });
  const Eigen::Vector2d azimuth(std::cos(beam.azimuth), std::sin(beam.azimuth));
  const Eigen::Matrix2d response = TangentResponse(beam.incidence, beam.azimuth, refractive_index);
  const Eigen::Matrix2d tangent = response * slopes * response.transpose();

  // To first order atan(t - t_still) is t - t_still. The path in still water is d / cos(theta_r), its derivative by
  // the in-plane tangent is d sin(theta_r), and the reported depth is the path times cos(theta_r).
  const double refracted = StillWaterRefraction(beam.incidence, refractive_index);
  const double in_plane = std::sqrt(azimuth.dot(tangent * azimuth));
  return {2 * std::sqrt(tangent(0, 0)), 2 * std::sqrt(tangent(1, 1)), 2 * std::sqrt(tangent.trace()),
          2 * in_plane * std::sin(refracted) * std::cos(refracted)};
}

}  // namespace albtpu
