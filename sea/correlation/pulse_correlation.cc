#include "sea/correlation/pulse_correlation.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sea/response/slope_covariance.h"

namespace albtpu {

PulseCorrelation CorrelationOf(const SharedWaves& shared, const SharedWaves& pulse) {
  const auto ratio = [](double part, double whole) { return whole > 0 ? std::clamp(part / whole, -1.0, 1.0) : 0; };
  const Eigen::Matrix2d& slopes = pulse.footprint.slopes;
  // Along the crests of waves of one direction the sums of their harmonics leave up to 2e-4 of the slopes' variance.
  constexpr double kNone = 1e-3;
  const auto of_slopes = [&](int i) {
    return slopes(i, i) > kNone * slopes.trace() ? ratio(shared.footprint.slopes(i, i), slopes(i, i)) : 0;
  };
  const Eigen::Matrix3d errors = shared.errors(), own = pulse.errors();
  return {.slope_x = of_slopes(0),
          .slope_y = of_slopes(1),
          .horizontal = ratio(errors(0, 0) + errors(1, 1), own(0, 0) + own(1, 1)),
          .vertical = ratio(errors(2, 2), own(2, 2)),
          .vertical_first = ratio(shared.first_order(2, 2), pulse.first_order(2, 2)),
          .vertical_second = ratio(shared.second_order(2, 2), pulse.second_order(2, 2)),
          .height = ratio(shared.footprint.heights, pulse.footprint.heights)};
}

WaveCorrelation::WaveCorrelation(const HarmonicSpectrum& spectrum, const WaveMotion& motion)
    : waves_(spectrum, motion),
      points_(waves_.AtPoints()),
      at_once_(points_, motion, 0),
      slopes_(points_.Whole().slopes) {}

BeamCorrelation::BeamCorrelation(const WaveCorrelation& sea, const BeamOptions& beam, double refractive_index)
    : sea_(sea), beam_(beam), waves_(sea.waves().Under(beam)) {
  assert(std::isinf(beam.source_height));
  const Eigen::Vector2d along(std::cos(beam.azimuth), std::sin(beam.azimuth));
  const Eigen::Matrix2d axes = (Eigen::Matrix2d() << along, Eigen::Vector2d(-along.y(), along.x())).finished();
  const EffectiveGains gains =
      EffectiveGainsOf(beam.incidence, refractive_index, axes.transpose() * sea.slopes() * axes);

  // The point is reported at the end of the measured path along the still-water ray: the path times the sine of its
  // angle ahead, and times its cosine down. Errors are reported minus true.
  const double refracted = StillWaterRefraction(beam.incidence, refractive_index);
  Eigen::Matrix3d errors = Eigen::Matrix3d::Zero();  // by (tangent along, tangent across, secant)
  errors.topLeftCorner<2, 2>() = -axes;
  errors.topRightCorner<2, 1>() = std::sin(refracted) * along;
  errors(2, 2) = -std::cos(refracted);
  gain_ = errors * gains.gain * axes.transpose();
  for (int i = 0; i < 3; ++i) {
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    for (int j = 0; j < 3; ++j) sum += errors(i, j) * gains.curvature[j];
    curvature_[i] = axes * sum * axes.transpose();
  }
  pulse_ = Between(Eigen::Vector2d::Zero(), 0);
}

SharedWaves BeamCorrelation::SharedBy(const WaveCovariance& footprint, const Eigen::Matrix3d& pairs) const {
  SharedWaves shared{footprint, gain_ * footprint.slopes * gain_.transpose(), {}};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      const double second = 0.5 * MeanOfForms(curvature_[i], curvature_[j], pairs);
      shared.second_order(i, j) = shared.second_order(j, i) = second;
    }
  }
  return shared;
}

SharedWaves BeamCorrelation::Between(const Eigen::Vector2d& apart, double later) const {
  const LagDensity density(beam_);
  const WaveCovariance footprint = waves_.Between(apart, later);
  if (later == 0) return SharedBy(footprint, sea_.at_once().MeanPairs(density, apart));
  const SlopeLags lags(sea_.points(), sea_.waves().motion(), later, apart.norm() + density.reach());
  return SharedBy(footprint, lags.MeanPairs(density, apart));
}

SharedWaves BeamCorrelation::SharedNearly(const WaveCovariance& footprint) const {
  const Eigen::Matrix2d &shared = footprint.slopes, &own = pulse_.footprint.slopes;
  const double squares = own.squaredNorm();
  return {footprint, gain_ * shared * gain_.transpose(),
          pulse_.second_order * (squares > 0 ? shared.squaredNorm() / squares : 0)};
}

SharedWaves BeamCorrelation::InCell(const SurfaceCell& cell) const {
  return SharedBy(waves_.InCell(cell),
                  sea_.at_once().MeanPairs(LagDensity(beam_, cell.side, cell.orientation), Eigen::Vector2d::Zero()));
}

}  // namespace albtpu
