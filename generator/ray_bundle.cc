#include "generator/ray_bundle.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

namespace albtpu {
namespace {

// The bits of `x` and `y` in turn, those of x the higher.
std::uint32_t Interleave(std::uint16_t x, std::uint16_t y) {
  std::uint32_t both = 0;
  for (int bit = 0; bit < 16; ++bit) {
    both |= ((x >> bit & 1u) << (2 * bit + 1)) | ((y >> bit & 1u) << (2 * bit));
  }
  return both;
}

}  // namespace

RayBundle::RayBundle(std::vector<Ray> rays, double refractive_index)
    : count_(static_cast<int>(rays.size())), refractive_index_(refractive_index) {
  assert(!rays.empty() && refractive_index >= 1);
  direction_ = rays.front().direction;
  Eigen::Vector2d low = rays.front().at_zero, high = low;
  for (const Ray& ray : rays) {
    assert(ray.direction == direction_);
    low = low.cwiseMin(ray.at_zero);
    high = high.cwiseMax(ray.at_zero);
  }
  // One scale for both axes: the steps of the curve are square.
  const double steps_per_metre = 65535 / std::max((high - low).maxCoeff(), 1e-9);
  std::vector<std::pair<std::uint32_t, int>> order(rays.size());
  for (int j = 0; j < count_; ++j) {
    const Eigen::Vector2d at = (rays[j].at_zero - low) * steps_per_metre;
    order[j] = {Interleave(static_cast<std::uint16_t>(at.x()), static_cast<std::uint16_t>(at.y())), j};
  }
  std::sort(order.begin(), order.end());
  const int padded = (count_ + kPadding - 1) / kPadding * kPadding;
  for (int j = 0; j < padded; ++j) {
    const Ray& ray = rays[order[std::min(j, count_ - 1)].second];
    x_.push_back(static_cast<float>(ray.at_zero.x()));
    y_.push_back(static_cast<float>(ray.at_zero.y()));
  }
}

}  // namespace albtpu
