#include "annotate/answers/coordinate_spread.h"

#include <algorithm>
#include <bit>

namespace albtpu::annotate {
namespace {

// A bin has the numbers of one sign and exponent whose first three bits of the mantissa are the same: its width is at
// most 1/8 of a number in it, and so its middle within 1/16.
constexpr int kDroppedBits = 20;
constexpr std::size_t kBins = std::size_t{1} << (32 - kDroppedBits);
constexpr std::uint32_t kSignBit = 1u << 31;

// Bits that increase with the number: IEEE 754 stores sign and magnitude.
std::uint32_t OrderedBits(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return (bits & kSignBit) != 0 ? ~bits : bits | kSignBit;
}

float FromOrderedBits(std::uint32_t bits) {
  return std::bit_cast<float>((bits & kSignBit) != 0 ? bits & ~kSignBit : ~bits);
}

}  // namespace

void CoordinateSpread::Add(float value) {
  if (bins_.empty()) bins_.resize(kBins);
  ++count_;
  ++bins_[OrderedBits(value) >> kDroppedBits];
  least_ = std::min(least_, value);
  greatest_ = std::max(greatest_, value);
}

void CoordinateSpread::Merge(const CoordinateSpread& other) {
  if (other.count_ == 0) return;
  if (bins_.empty()) bins_.resize(kBins);
  count_ += other.count_;
  for (std::size_t i = 0; i < kBins; ++i) bins_[i] += other.bins_[i];
  least_ = std::min(least_, other.least_);
  greatest_ = std::max(greatest_, other.greatest_);
}

float CoordinateSpread::middle() const {
  std::uint64_t below = 0;
  std::size_t bin = 0;
  while (2 * (below + bins_[bin]) < count_) below += bins_[bin++];
  const std::uint32_t center = (static_cast<std::uint32_t>(bin) << kDroppedBits) | (1u << (kDroppedBits - 1));
  return std::clamp(FromOrderedBits(center), least_, greatest_);
}

}  // namespace albtpu::annotate
