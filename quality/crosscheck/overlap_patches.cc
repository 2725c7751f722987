#include "quality/crosscheck/overlap_patches.h"

#include <algorithm>
#include <cmath>

namespace albtpu::quality {
namespace {

constexpr double kGreatestIndex = 2e9;  // Of a patch: so that two fit 64 bits.

// The finalizer of SplitMix64 (Steele, Lea and Flood 2014).
std::uint64_t Hash(std::uint64_t key) {
  key = (key ^ key >> 30) * 0xbf58476d1ce4e5b9U;
  key = (key ^ key >> 27) * 0x94d049bb133111ebU;
  return key ^ key >> 31;
}

std::uint64_t Pack(std::int32_t column, std::int32_t row) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(column)) << 32 |
         static_cast<std::uint32_t>(row);
}

}  // namespace

std::uint64_t OverlapPatches::KeyOf(const AnnotatedPoint& point) const {
  if (!point.has_number) return 0;
  const double column = std::floor(point.x * metres_per_unit_ / side_);
  const double row = std::floor(point.y * metres_per_unit_ / side_);
  if (!(std::abs(column) < kGreatestIndex && std::abs(row) < kGreatestIndex)) return 0;
  const std::uint64_t key = Pack(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row));
  return (Hash(key) & mask_) == 0 ? key : 0;
}

void OverlapPatches::Find(std::span<const AnnotatedPoint> points) {
  for (const AnnotatedPoint& point : points) {
    const std::uint64_t key = KeyOf(point);
    if (key == 0) continue;
    Known& known = known_[key];
    const auto line = static_cast<std::uint16_t>(point.line);
    if (known.points == 0) known.first_line = line;
    known.overlap |= known.first_line != line;
    ++known.points;
    if (known_.size() > kMaxKnown) Thin();
  }
}

void OverlapPatches::Thin() {
  mask_ = mask_ << 1 | 1;
  std::erase_if(known_, [this](const auto& each) { return (Hash(each.first) & mask_) != 0; });
  std::erase_if(chosen_, [this](const auto& each) { return (Hash(each.first) & mask_) != 0; });
}

void OverlapPatches::Choose() {
  std::erase_if(known_, [](const auto& each) { return !each.second.overlap; });
  const auto points = [this] {
    std::size_t sum = 0;
    for (const auto& [key, known] : known_) sum += known.points;
    return sum;
  };
  while (points() > kMostPoints) Thin();
  chosen_.reserve(known_.size());
  for (const auto& [key, known] : known_) chosen_.emplace(key, UINT32_MAX);
  known_ = {};
}

void OverlapPatches::Fill(std::span<const AnnotatedPoint> points) {
  const double factor = VerticalFactor(coverage_);
  const auto variance = [factor](float tvu) { return std::pow(tvu / factor, 2); };
  for (const AnnotatedPoint& point : points) {
    const std::uint64_t key = KeyOf(point);
    const auto found = key == 0 ? chosen_.end() : chosen_.find(key);
    if (found == chosen_.end()) continue;
    const double x = point.x * metres_per_unit_, y = point.y * metres_per_unit_;
    if (found->second == UINT32_MAX) {
      found->second = static_cast<std::uint32_t>(patches_.size());
      patches_.push_back({(std::floor(x / side_) + 0.5) * side_, (std::floor(y / side_) + 0.5) * side_, {}});
    }
    Patch& patch = patches_[found->second];
    const double sea = variance(point.tvu_sea);
    const double own = variance(point.tvu_pulse) + variance(point.tvu_line);
    const double air = std::max(own - sea, 0.0);
    // A point has the horizontal entries of the total alone. Nearly all of them belong to pulse and line: the errors
    // common to a survey are mostly vertical. The correlations are those of the total.
    const float of_height =
        point.variance_z > 0 ? static_cast<float>(std::sqrt(std::min(own / point.variance_z, 1.0))) : 0;
    const double of_sea = point.thu > 0 ? std::min(std::pow(point.thu_sea / point.thu, 2), 1.0) : 0;
    patch.points.push_back({.x = static_cast<float>(x - patch.x),
                            .y = static_cast<float>(y - patch.y),
                            .z = static_cast<float>(point.z),
                            .variance_air = static_cast<float>(air),
                            .variance_sea = static_cast<float>(sea),
                            .xx = point.variance_x,
                            .yy = point.variance_y,
                            .xy = point.covariance_xy,
                            .xz = of_height * point.covariance_xz,
                            .yz = of_height * point.covariance_yz,
                            .sea_in_horizontal = static_cast<float>(of_sea),
                            .depth = point.depth,
                            .incidence = point.incidence,
                            .line = static_cast<std::uint16_t>(point.line)});
  }
}

}  // namespace albtpu::quality
