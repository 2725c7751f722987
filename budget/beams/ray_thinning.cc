#include "budget/beams/ray_thinning.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace albtpu {
namespace {

struct Place {
  double time;
  std::uint32_t ray;
};

// The finalizer of a 64-bit hash: every bit of the input changes half of the bits of the result.
std::uint64_t Mixed(std::uint64_t x) {
  x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdULL;
  x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53ULL;
  return x ^ (x >> 33);
}

// Rays of greater rank stay.
std::uint64_t Rank(const AirRay& ray) {
  const auto separation_class = static_cast<std::uint64_t>(64 + std::floor(2 * std::log2(ray.separation)));
  return separation_class << 48 | Mixed(std::bit_cast<std::uint64_t>(ray.time)) >> 16;
}

bool IsFinite(const AirRay& ray) {
  return std::isfinite(ray.time) && ray.water_point.allFinite() && ray.direction.allFinite() &&
         std::isfinite(ray.separation) && ray.separation > 0;
}

}  // namespace

std::vector<AirRay> ThinRays(std::span<const AirRay> rays, const RayThinning& thinning) {
  std::vector<Place> places;
  places.reserve(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (IsFinite(rays[i])) places.push_back({rays[i].time, static_cast<std::uint32_t>(i)});
  tbb::parallel_sort(
      places, [](const Place& a, const Place& b) { return a.time != b.time ? a.time < b.time : a.ray < b.ray; });

  const auto bin_of = [&](const Place& place) { return std::floor(place.time / thinning.bin); };
  std::size_t bins = 0;
  for (std::size_t i = 0; i < places.size(); ++i) bins += i == 0 || bin_of(places[i]) != bin_of(places[i - 1]);
  const std::size_t cap =
      std::clamp<std::size_t>(thinning.max_rays / std::max<std::size_t>(bins, 1), 1, thinning.rays_per_bin);

  std::vector<AirRay> kept;
  kept.reserve(std::min(places.size(), bins * cap));
  std::vector<std::pair<std::uint64_t, std::uint32_t>> ranked;
  for (std::size_t first = 0, last = 0; first < places.size(); first = last) {
    while (last < places.size() && bin_of(places[last]) == bin_of(places[first])) ++last;
    ranked.clear();
    for (std::size_t i = first; i < last; ++i)
      ranked.emplace_back(Rank(rays[places[i].ray]), static_cast<std::uint32_t>(i));
    if (ranked.size() > cap) {
      std::nth_element(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(cap), ranked.end(),
                       [](const auto& a, const auto& b) { return a > b; });
      ranked.resize(cap);
      std::sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    }
    for (const auto& [rank, i] : ranked) kept.push_back(rays[places[i].ray]);
  }
  return kept;
}

}  // namespace albtpu
