#include "tables/query/sorted_pulses.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>
#include <vector>

namespace albtpu {
// Sorting takes an eighth of the time of interpolating in random order. It pays if the table, whose records have 16
// bytes, does not fit into the second-level cache, and if the pulses, each of which reads 64 records, read at least
// half as many records as the table has: with fewer, neighbours rarely find their common records in the cache
// (interpolation_bench).
std::size_t SortedPulses::Fewest(std::size_t records) {
  constexpr std::size_t kRecordsInCache = 1 << 16, kRecordsAPulse = 128;
  const std::size_t fewest = records / kRecordsAPulse;
  return records <= kRecordsInCache || fewest > kMost ? kNever : fewest;
}

SortedPulses::SortedPulses(const Grid& grid, const PulseColumns& pulses, std::size_t begin, std::size_t count)
    : begin_(begin), count_(count) {
  assert(count > 0 && count <= kMost && count % AxisLookup::kPadding == 0);
  FindPlaces(grid, pulses);
  Sort(grid, pulses);
}

// A counting sort by the cell of a pulse without the last axis, because all its nodes in a cell take few cache lines.
// If there are many cells, neighbours share a count.
void SortedPulses::FindPlaces(const Grid& grid, const PulseColumns& pulses) {
  constexpr std::int32_t kMaxCounts = 1 << 14;
  std::vector<std::int32_t> rows(count_);
  for (std::size_t axis = 0; axis < grid.last(); ++axis) {
    if (pulses.axis[axis].size() <= 1) continue;
    grid.axis(axis).AddLowerNodes(pulses.axis[axis].data() + begin_, count_, static_cast<std::int32_t>(grid.step(axis)),
                                  rows.data());
  }
  const std::int32_t last = *std::max_element(rows.begin(), rows.end());
  int shift = 0;
  while (last >> shift >= kMaxCounts) ++shift;
  std::vector<std::uint32_t> counts(static_cast<std::size_t>(last >> shift) + 1);
  for (std::int32_t& row : rows) {
    row >>= shift;
    ++counts[static_cast<std::size_t>(row)];
  }
  std::uint32_t before = 0;
  for (std::uint32_t& count : counts) before += std::exchange(count, before);
  places_ = std::make_unique_for_overwrite<std::uint32_t[]>(count_);
  for (std::size_t i = 0; i < count_; ++i) places_[i] = counts[static_cast<std::size_t>(rows[i])]++;
}

void SortedPulses::Sort(const Grid& grid, const PulseColumns& pulses) {
  pulses_ = pulses;
  pulses_.size = count_;
  coordinates_ = std::make_unique_for_overwrite<float[]>(grid.axis_count() * count_);
  for (std::size_t axis = 0; axis < grid.axis_count(); ++axis) {
    if (pulses.axis[axis].size() <= 1) continue;
    const float* from = pulses.axis[axis].data() + begin_;
    float* to = coordinates_.get() + axis * count_;
    for (std::size_t i = 0; i < count_; ++i) to[places_[i]] = from[i];
    pulses_.axis[axis] = std::span(to, count_);
  }
}

}  // namespace albtpu
