#include "sea/response/sea_response.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sea/response/footprint_shift.h"

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

namespace {

// Of (tangent along, tangent across, secant) per depth.
Eigen::Matrix3d RayCovariance(const EffectiveGains& gains, double incidence, const Eigen::Matrix2d& slopes,
                              const Eigen::Matrix3d& pairs, const FootprintShift& shift) {
  const double tau = std::tan(incidence);
  const Eigen::Matrix2d first = slopes + tau * tau * (Eigen::Matrix2d(pairs.topLeftCorner<2, 2>()) + shift.spread);
  Eigen::Matrix<double, 3, 2> bent;  // the rows H_i contracted with the drift
  for (int i = 0; i < 3; ++i)
    bent.row(i) = shift.drift[0] * gains.curvature[i].col(0) + shift.drift[1] * gains.curvature[i].col(1);
  const Eigen::Matrix3d cross = -tau * gains.gain * bent.transpose();
  Eigen::Matrix3d covariance = gains.gain * first * gains.gain.transpose() + cross + cross.transpose();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      const double second = 0.5 * MeanOfForms(gains.curvature[i], gains.curvature[j], pairs);
      covariance(i, j) += second;
      if (j != i) covariance(j, i) += second;
    }
  }
  return covariance;
}

}  // namespace

SeaResponse::SeaResponse(const HarmonicSpectrum& spectrum, double refractive_index)
    : spectrum_(spectrum), refractive_index_(refractive_index), slopes_(spectrum_.Covariance()) {}

BeamResponse SeaResponse::operator()(const BeamOptions& beam) const {
  assert(std::isinf(beam.source_height));
  return AlongDirection(beam.incidence, beam.azimuth, {FootprintKernel(beam.profile, beam.footprint)}).front();
}

std::vector<BeamResponse> SeaResponse::AlongDirection(double incidence, double azimuth,
                                                      const std::vector<FootprintKernel>& footprints) const {
  const Eigen::Vector2d along(std::cos(azimuth), std::sin(azimuth));
  const Eigen::Matrix2d axes = (Eigen::Matrix2d() << along, Eigen::Vector2d(-along.y(), along.x())).finished();
  const EffectiveGains gains = EffectiveGainsOf(incidence, refractive_index_, axes.transpose() * slopes_ * axes);
  const BeamSpectrum spectrum = spectrum_.AcrossBeam(incidence, azimuth);
  Eigen::Index lags = 0;
  for (const FootprintKernel& footprint : footprints) lags = std::max(lags, footprint.overlap().size());
  const LagProducts products(LagCovariances(spectrum, static_cast<int>(lags)));

  // The reported position is that of still water, and the reported depth the path times cos(refracted). Errors are the
  // displacements of the ray with the opposite sign.
  const double refracted = StillWaterRefraction(incidence, refractive_index_);
  Eigen::Matrix3d errors = Eigen::Matrix3d::Zero();
  errors.topLeftCorner<2, 2>() = -axes;
  errors(2, 2) = -std::cos(refracted);
  const Eigen::Vector3d still(std::tan(refracted), 0, 1 / std::cos(refracted));
  std::vector<BeamResponse> responses;
  for (const FootprintKernel& footprint : footprints) {
    const Eigen::Matrix3d pairs = SlopePairs(products, incidence, footprint);
    const Eigen::Matrix3d ray = RayCovariance(gains, incidence, FootprintSlopes(spectrum, footprint), pairs,
                                              FootprintShiftOf(spectrum, products, pairs, footprint));
    const Eigen::Matrix3d at_surface =
        gains.gain * HeightSlopeCovariance(spectrum, products, footprint) * gains.gain.transpose();
    responses.push_back({errors * ray * errors.transpose(), errors * at_surface * errors.transpose(),
                         errors * (gains.mean - still), along});
  }
  return responses;
}

}  // namespace albtpu
