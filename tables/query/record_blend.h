// The weighted means of records at the corners around many pulses.
#pragma once

#include <tbb/cache_aligned_allocator.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace albtpu {

// Four numbers that are known at a node, side by side, so that they are read and blended at once.
inline constexpr std::size_t kRecordSize = 4;
// One record a node, and one more, so that the last has a neighbour too.
using Records = std::vector<float, tbb::cache_aligned_allocator<float>>;

// Pulses among records. Axes are blended in this order, whatever the batch: those first that change least
// along a flight line, so that what they give is kept from pulse to pulse.
struct BlendedPulses {
  // Of records with depth. Those without have no outer footprint: it is their last axis.
  enum Outer { kWindSpeed, kFetch, kAzimuth, kIncidence, kFootprint, kOuterCount };

  std::ptrdiff_t first = 0;                           // the record that `rows` count from
  const std::int32_t* rows = nullptr;                 // of each pulse, the record at its lower corner
  std::array<const float*, kOuterCount> fractions{};  // of the way to the upper corner, 0 to 1; or null
  std::array<std::ptrdiff_t, kOuterCount> steps{};    // records to the upper corner; 0: the axis has one node
  const float* last = nullptr;                        // fractions on the last axis, whose step is 1
  std::size_t count = 0;
};

// Writes `count` records to `blended`: at a corner exactly what stands there, elsewhere within 1e-6 of the
// largest of the corners.
void Blend(const float* records, const BlendedPulses& pulses, float* blended);

}  // namespace albtpu
