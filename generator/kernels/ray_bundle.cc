#include "generator/kernels/ray_bundle.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>

#include "sea/response/closed_form.h"

namespace albtpu {
namespace {

// The interleaved bits of `x` and `y`, x with the higher bit of each pair.
std::uint32_t Interleave(std::uint16_t x, std::uint16_t y) {
  std::uint32_t both = 0;
  for (int bit = 0; bit < 16; ++bit) both |= ((x >> bit & 1u) << (2 * bit + 1)) | ((y >> bit & 1u) << (2 * bit));
  return both;
}

}  // namespace

RayBundle::RayBundle(const std::vector<Ray>& rays, double refractive_index)
    : count_(static_cast<int>(rays.size())), refractive_index_(refractive_index) {
  assert(!rays.empty() && refractive_index >= 1);
  direction_ = rays.front().direction;
  Eigen::Vector2d low = rays.front().at_zero, high = low;
  for (const Ray& ray : rays) {
    assert(ray.direction == direction_);
    low = low.cwiseMin(ray.at_zero);
    high = high.cwiseMax(ray.at_zero);
  }
  // Both axes have the same scale, so that the curve fills squares.
  const double min_width = 1e-9;
  const double per_metre = 65535 / std::max((high - low).maxCoeff(), min_width);
  std::vector<std::pair<std::uint32_t, int>> order(rays.size());
  for (int j = 0; j < count_; ++j) {
    const Eigen::Vector2d at = (rays[j].at_zero - low) * per_metre;
    order[j] = {Interleave(static_cast<std::uint16_t>(at.x()), static_cast<std::uint16_t>(at.y())), j};
  }
  std::sort(order.begin(), order.end());

  const int rows = (count_ + kStrips - 1) / kStrips;
  x_.resize(rows * kStrips);
  y_.resize(rows * kStrips);
  const auto store = [&](int place, int along_the_curve) {
    const Eigen::Vector2f at = rays[order[along_the_curve].second].at_zero.cast<float>();
    x_[place] = at.x();
    y_[place] = at.y();
  };
  int next = 0;
  for (int strip = 0; strip < kStrips; ++strip)
    for (int place = strip; place < count_; place += kStrips) store(place, next++);
  for (int place = count_; place < rows * kStrips; ++place) store(place, count_ - 1);
}

StillWater StillWaterOf(const RayBundle& rays) {
  const double r = 1 / rays.refractive_index();
  const Eigen::Vector3d direction = rays.direction();
  const double s0 = std::sqrt(1 - r * r + r * r * direction.z() * direction.z());
  return {static_cast<float>(s0), static_cast<float>(-r * direction.z()), static_cast<float>(r * direction.x()),
          static_cast<float>(r * direction.y()), static_cast<float>(1 - r * r)};
}

void IntersectOne(const RayBundle& rays, const HeightView& surface, int ray, float& height, float& rise_x,
                  float& rise_y) {
  const Hit hit = Intersect(surface, Ray{rays.direction(), {rays.x()[ray], rays.y()[ray]}});
  const Eigen::Vector2d rise = hit.facet.slope * static_cast<double>(surface.spacing);
  height = static_cast<float>(hit.height);
  rise_x = static_cast<float>(rise.x());
  rise_y = static_cast<float>(rise.y());
}

TracedBundle MeansOf(const RayBundle& rays, const PacketSums& sums) {
  double mean[kPacketSums];
  for (int k = 0; k < kPacketSums; ++k) mean[k] = sums.sum[k] / rays.count();
  const RefractedRay still = RefractAtSlope(rays.direction(), {0, 0}, rays.refractive_index());
  const Eigen::Vector2d tangent(mean[kTangentX], mean[kTangentY]);  // less the tangent in still water
  TracedBundle traced;
  traced.beam.tangent = still.tangent + tangent;
  traced.beam.height_tangent = Eigen::Vector2d(mean[kHeightTangentX], mean[kHeightTangentY]) - mean[kHeight] * tangent;
  traced.beam.secant = still.secant + mean[kSecant];
  traced.beam.height_secant = mean[kHeightSecant] - mean[kHeight] * mean[kSecant];
  traced.beam.slope = {mean[kSlopeX], mean[kSlopeY]};
  traced.beam.slope_squares = {mean[kSlopeXX], mean[kSlopeYY], mean[kSlopeXY]};
  traced.height = mean[kHeight];
  traced.unshifted_slope = {mean[kUnshiftedX], mean[kUnshiftedY]};
  traced.unshifted_slope_squares = {mean[kUnshiftedXX], mean[kUnshiftedYY], mean[kUnshiftedXY]};
  traced.unshifted_height_slope = Eigen::Vector2d(mean[kUnshiftedHeightX], mean[kUnshiftedHeightY]) -
                                  mean[kUnshiftedHeight] * traced.unshifted_slope;
  traced.unsettled_rays = sums.unsettled_rays;
  return traced;
}

}  // namespace albtpu
