#include "generator/kernels/ray_bundle.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

namespace albtpu {
namespace {

// The interleaved bits of `x` and `y`, x with the higher bit of each pair.
std::uint32_t Interleave(std::uint16_t x, std::uint16_t y) {
  std::uint32_t both = 0;
  for (int bit = 0; bit < 16; ++bit) {
    both |= ((x >> bit & 1u) << (2 * bit + 1)) | ((y >> bit & 1u) << (2 * bit));
  }
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
  for (int strip = 0; strip < kStrips; ++strip) {
    for (int place = strip; place < count_; place += kStrips) store(place, next++);
  }
  for (int place = count_; place < rows * kStrips; ++place) store(place, count_ - 1);
}

}  // namespace albtpu
