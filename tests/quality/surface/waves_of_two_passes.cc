#include "tests/quality/surface/waves_of_two_passes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "quality/surface/node.h"
#include "sea/angle.h"
#include "sea/response/closed_form.h"

namespace albtpu::quality {
namespace {

// Where a beam goes.
Eigen::Vector2d Along(const SurfacePoint& point) {
  const double azimuth = RadiansOfDegrees(90 - double{point.azimuth});
  return {std::cos(azimuth), std::sin(azimuth)};
}

}  // namespace

WavesOfTwoPasses::WavesOfTwoPasses(const HarmonicSpectrum& sea, double footprint, double index,
                                   const Eigen::Vector3d& upward)
    : waves_(MovingWaves(sea).Under({.footprint = footprint})),
      slopes_(MovingWaves(sea).AtPoints().Whole().slopes),
      index_(index),
      upward_(upward) {}

Eigen::RowVector2d WavesOfTwoPasses::GainOf(const SurfacePoint& point) const {
  const double incidence = RadiansOfDegrees(point.incidence), still = StillWaterRefraction(incidence, index_);
  const Eigen::Vector2d along = Along(point);
  const Eigen::Matrix2d axes = (Eigen::Matrix2d() << along, Eigen::Vector2d(-along.y(), along.x())).finished();
  // The point is reported at the end of the measured path along the still-water ray: minus the tangent, plus the secant
  // times the sine of its angle, and minus the secant times the cosine upwards.
  Eigen::Matrix3d errors = Eigen::Matrix3d::Zero();
  errors.topLeftCorner<2, 2>() = -axes;
  errors.topRightCorner<2, 1>() = std::sin(still) * along;
  errors(2, 2) = -std::cos(still);
  const EffectiveGains gains = EffectiveGainsOf(incidence, index_, axes.transpose() * slopes_ * axes);
  return upward_.transpose() * errors * gains.gain * axes.transpose();
}

Eigen::Vector2d WavesOfTwoPasses::EntryOf(const SurfacePoint& point) const {
  const double still = StillWaterRefraction(RadiansOfDegrees(point.incidence), index_);
  return Eigen::Vector2d(point.x, point.y) - point.depth * std::tan(still) * Along(point);
}

double WavesOfTwoPasses::Covariance(const SurfacePoint& one, const SurfacePoint& other) const {
  const WaveCovariance shared = waves_.Between(EntryOf(other) - EntryOf(one), other.time - one.time);
  return one.depth * other.depth * (GainOf(one) * shared.slopes * GainOf(other).transpose()).value();
}

double WavesOfTwoPasses::VarianceOf(std::span<const SurfacePoint> points) const {
  constexpr int kPairs = 24;  // Of two passes, spread over both.
  std::vector<std::span<const SurfacePoint>> passes;
  for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
    for (end = begin + 1; end < points.size(); ++end)
      if (points[end].flight_line != points[begin].flight_line || points[end].time - points[end - 1].time > kPassPause)
        break;
    passes.push_back(points.subspan(begin, end - begin));
  }
  double sum = 0;
  for (std::size_t i = 1; i < passes.size(); ++i) {
    const std::span<const SurfacePoint> fore = passes[i - 1], aft = passes[i];
    if (fore.front().flight_line != aft.front().flight_line) continue;
    const std::size_t all = fore.size() * aft.size(), some = std::min<std::size_t>(all, kPairs);
    double mean = 0;
    for (std::size_t k = 0; k < some; ++k) {
      const std::size_t pair = all == some
                                   ? k
                                   : static_cast<std::size_t>(std::fmod(static_cast<double>(k) * std::numbers::phi, 1) *
                                                              static_cast<double>(all));
      mean += Covariance(fore[pair % fore.size()], aft[pair / fore.size()]) / static_cast<double>(some);
    }
    sum += 2 * mean * static_cast<double>(all);
  }
  return sum / std::pow(static_cast<double>(points.size()), 2);
}

}  // namespace albtpu::quality
