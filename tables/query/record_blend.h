// The weighted means of the records at the corners around each of many pulses.
#pragma once

#include <tbb/cache_aligned_allocator.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tables/table_schema.h"

namespace albtpu {

// Four numbers that are known at a node, side by side, so that one load reads all four.
inline constexpr std::size_t kRecordSize = 4;
// A record for each node, and one more, so that the last one has a neighbour, too.
using Records = std::vector<float, tbb::cache_aligned_allocator<float>>;

// Pulses among records. The axes are blended in the order of their slots, those that change least along a flight
// line first, so that their result is kept from pulse to pulse. The order, and with it the rounding, does not
// depend on the pulses.
//
// In records over all axes of the sea surface, kSlowest is the wind speed, kSlow the fetch, kMiddle the azimuth, kFast
// the incidence, kFastest the footprint, and the innermost axis is the depth. In records over all axes but the depth,
// the innermost axis is the footprint, and kFastest is unused.
struct BlendedPulses {
  // A slot for each axis but the innermost one, on which neighbouring records are neighbouring nodes. The result of the
  // first two is kept while they and the cell stay the same; that of the third on both of its sides, while the first
  // two and the cell stay the same. An unused slot has step 0 and fraction 0; only kFastest may have no fractions at
  // all, which takes the kernel for four slots.
  enum Slot { kSlowest, kSlow, kMiddle, kFast, kFastest, kSlotCount };
  static_assert(kSlotCount == kMaxAxes - 1);

  std::ptrdiff_t first = 0;                          // the record that `rows` count from
  const std::int32_t* rows = nullptr;                // the record at the lower corner of each pulse
  std::array<const float*, kSlotCount> fractions{};  // of the distance to the upper corner, 0 to 1
  std::array<std::ptrdiff_t, kSlotCount> steps{};    // records to the upper corner; 0: the axis has one node
  const float* innermost = nullptr;                  // fractions on the innermost axis, whose step is 1
  std::size_t count = 0;
};

// Writes `count` records to `blended`: at a corner exactly the record there, elsewhere within 1e-6 of the largest
// of the corners.
void Blend(const float* records, const BlendedPulses& pulses, float* blended);

}  // namespace albtpu
