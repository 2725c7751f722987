#include "tests/quality/surface/waves_of_two_passes.h"

#include <cmath>
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

std::size_t Part(double turns, double of) { return static_cast<std::size_t>((turns - std::floor(turns)) * of); }

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
  constexpr int kPairs = 128;  // Of two passes.
  std::vector<std::span<const SurfacePoint>> passes;
  for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
    for (end = begin + 1; end < points.size(); ++end)
      if (points[end].flight_line != points[begin].flight_line || points[end].time - points[end - 1].time > kPassPause)
        break;
    passes.push_back(points.subspan(begin, end - begin));
  }
  double sum = 0;
  for (std::size_t pass = 1; pass < passes.size(); ++pass) {
    const std::span<const SurfacePoint> fore = passes[pass - 1], aft = passes[pass];
    if (fore.front().flight_line != aft.front().flight_line) continue;
    const auto of_fore = static_cast<double>(fore.size()), of_aft = static_cast<double>(aft.size());
    const bool all = of_fore * of_aft <= kPairs;
    const int pairs = all ? static_cast<int>(of_fore * of_aft) : kPairs;
    double mean = 0;
    for (int k = 0; k < pairs; ++k) {
      // Of many pairs, those of an even sequence in two dimensions (R2, of Roberts).
      const auto i = all ? static_cast<std::size_t>(k) % fore.size() : Part(0.7548776662466927 * (k + 1), of_fore);
      const auto j = all ? static_cast<std::size_t>(k) / fore.size() : Part(0.5698402909980532 * (k + 1), of_aft);
      mean += Covariance(fore[i], aft[j]) / pairs;
    }
    sum += 2 * mean * of_fore * of_aft;
  }
  return sum / std::pow(static_cast<double>(points.size()), 2);
}

}  // namespace albtpu::quality
