// Where a block of pulses lies in a table.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tables/query/axis_lookup.h"
#include "tables/query/block.h"
#include "tables/query/pulse_columns.h"
#include "tables/query/record_blend.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// The axes of a table and of its records. Immutable.
class Grid {
 public:
  explicit Grid(const UncertaintyTable& table);

  const AxisLookup& axis(AxisId id) const { return axes_[Index(id)]; }
  // Records without depth from one node to the next; 0 where there is no next.
  std::ptrdiff_t step(AxisId id) const { return steps_[Index(id)]; }
  std::ptrdiff_t depths() const { return depths_; }

 private:
  std::vector<AxisLookup> axes_;
  std::array<std::ptrdiff_t, kAxisCount> steps_{};  // of the depth: 1
  std::ptrdiff_t depths_;
};

// Of pulses without azimuth there are two answers, one at each of these.
enum class Side { kDownwind, kCrosswind };

// Moves along pulses, block by block. Constant columns are located once.
class PulseBlock {
 public:
  // `most` pulses at the most will be in a block. All must outlive it.
  PulseBlock(const Grid& grid, const PulseColumns& pulses, std::size_t most);

  // To the pulses `first` to `first + count`, the latter not included.
  void MoveTo(std::size_t first, std::size_t count);

  std::size_t first() const { return first_; }
  std::size_t count() const { return count_; }
  bool azimuth_absent() const { return pulses_[AxisId::kAzimuth].empty(); }
  float depth(std::size_t i) const {
    return pulses_[AxisId::kDepth][IsConstant(AxisId::kDepth) ? 0 : first_ + i];
  }

  // The outcome of each pulse: outcome_code.
  const BlockOf<std::int32_t>& codes() const { return codes_; }
  bool all_inside() const { return all_inside_; }

  // Whether most pulses are in another cell than the one before, depth aside.
  bool IsScattered() const;

  // Among records without depth and with it. Pulses with an azimuth have one side, downwind.
  BlendedPulses WithoutDepth(Side side) const;
  BlendedPulses WithDepth(Side side) const;

 private:
  bool IsConstant(AxisId axis) const { return pulses_[axis].size() <= 1; }
  std::int32_t LocateConstant(AxisId axis, float coordinate, std::size_t most, BlockOf<float>& fractions);
  void LocateColumn(AxisId axis, BlockOf<std::int32_t>& rows);

  const Grid& grid_;
  const PulseColumns& pulses_;
  std::size_t first_ = 0, count_ = 0;
  std::int32_t constant_code_ = outcome_code::kInside, constant_row_ = 0, constant_depth_ = 0;
  std::int32_t downwind_row_ = 0, crosswind_row_ = 0;
  bool all_inside_ = false;
  BlockOf<std::int32_t> codes_, rows_, rows_with_depth_;
  std::array<BlockOf<float>, kAxisCount> fractions_;
  BlockOf<float> crosswind_;  // fractions
};

}  // namespace albtpu
