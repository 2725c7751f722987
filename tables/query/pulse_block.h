// The grid of a table, and the positions of a block of pulses in it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tables/query/axis_lookup.h"
#include "tables/query/pulse_columns.h"
#include "tables/query/record_blend.h"
#include "tables/table.h"

namespace albtpu {

// Blocks of pulses that are interpolated at a time: few enough for their data to stay in the nearest caches. For all
// values and standard errors of the sea surface, a block touches 25 KiB of PulseBlock and BlockValues, or 38 KiB if the
// azimuth is absent. The rest of BlockValues is for kinds of tables that have more sets of records.

inline constexpr std::size_t kBlock = 256;

// A number for each pulse of a block.
template <typename Number>
struct alignas(64) BlockOf {
  Number number[kBlock];

  Number& operator[](std::size_t i) { return number[i]; }
  const Number& operator[](std::size_t i) const { return number[i]; }
  Number* begin() { return number; }
  const Number* begin() const { return number; }
};

// The axes of a table and of its records, which lie over all axes or over all but the last. Immutable.
class Grid {
 public:
  explicit Grid(const Table& table);

  static constexpr std::size_t kNoAxis = kMaxAxes;

  std::size_t axis_count() const { return last_ + 1; }
  std::size_t last() const { return last_; }
  const AxisLookup& axis(std::size_t index) const { return axes_[index]; }
  // The records from one node to the next, in records without the last axis; 0 if the axis has one node. 1 for the
  // last axis itself.
  std::ptrdiff_t step(std::size_t axis) const { return steps_[axis]; }
  std::ptrdiff_t last_size() const { return last_size_; }

  // The axis whose column may be absent for Axis::alternatives(), or kNoAxis, and these coordinates.
  std::size_t axis_of_alternatives() const { return axis_of_alternatives_; }
  const std::vector<float>& alternatives() const { return alternatives_; }
  // The coordinate that stands for an absent column of any other axis: NaN if the axis needs a column.
  float absent_coordinate(std::size_t axis) const;

  // The axis that each slot blends, or kNoAxis, and the records from one of its nodes to the next.
  struct Slots {
    std::array<std::size_t, BlendedPulses::kSlotCount> axes;
    std::array<std::ptrdiff_t, BlendedPulses::kSlotCount> steps;
  };
  const Slots& slots(bool over_last_axis) const { return slots_[over_last_axis ? 1 : 0]; }

 private:
  Slots SlotsOf(const TableSchema& schema, bool over_last_axis) const;

  std::size_t last_;
  std::vector<AxisLookup> axes_;
  std::array<std::ptrdiff_t, kMaxAxes> steps_{};
  std::ptrdiff_t last_size_;
  std::size_t axis_of_alternatives_ = kNoAxis;
  std::vector<float> alternatives_;
  std::array<bool, kMaxAxes> absent_is_last_node_{};
  std::array<Slots, 2> slots_;
};

// Moves along pulses, block by block. Constant columns are located once.
//
// If the column of the axis of alternatives is absent, every pulse is at several places of the table, one after the
// other.
class PulseBlock {
 public:
  // A block holds at most `max_count` pulses. All arguments must outlive it.
  PulseBlock(const Grid& grid, const PulseColumns& pulses, std::size_t max_count);
  PulseBlock(const PulseBlock&) = delete;
  PulseBlock& operator=(const PulseBlock&) = delete;

  // Moves to the `count` pulses from `first` on.
  void MoveTo(std::size_t first, std::size_t count);

  std::size_t first() const { return first_; }
  std::size_t count() const { return count_; }
  // The number of places, and which of them the pulses are at: at first 0.
  std::size_t alternatives() const { return has_alternatives_ ? grid_.alternatives().size() : 1; }
  std::size_t alternative() const { return alternative_; }
  void TakeAlternative(std::size_t alternative);

  float coordinate(std::size_t axis, std::size_t i) const {
    return pulses_.axis[axis][IsConstant(axis) ? 0 : first_ + i];
  }

  // The outcome of each pulse, at the worst of its places: outcome_code.
  const BlockOf<std::int32_t>& codes() const { return codes_; }
  bool all_inside() const { return all_inside_; }

  // Whether most pulses are in another cell than the pulse before, apart from the last axis.
  bool IsScattered() const;

  // The pulses among the records over all axes, or over all but the last.
  const BlendedPulses& blended(bool over_last_axis) const {
    return blended_[over_last_axis ? 1 : 0][alternative_ == 0 ? 0 : 1];
  }

 private:
  bool IsConstant(std::size_t axis) const { return pulses_.axis[axis].size() <= 1; }
  // Returns the row.
  std::int32_t LocateConstant(std::size_t axis, float coordinate, BlockOf<float>& fractions);
  void LocateColumn(std::size_t axis, BlockOf<std::int32_t>& rows);
  void LocateAlternative(std::size_t alternative);
  void SetBlended(bool over_last_axis, bool later, BlendedPulses& pulses) const;

  const Grid& grid_;
  const PulseColumns& pulses_;
  const std::size_t max_count_;
  std::size_t first_ = 0, count_ = 0;
  std::int32_t constant_code_ = outcome_code::kInside, constant_row_ = 0, constant_last_ = 0;
  std::size_t alternative_ = 0, later_ = 0;
  bool has_alternatives_ = false, all_inside_ = false;
  // By over_last_axis; then at the first alternative, and at the later one that was located last, `later_`.
  std::array<std::array<BlendedPulses, 2>, 2> blended_;
  BlockOf<std::int32_t> codes_, rows_, rows_with_last_;
  std::array<BlockOf<float>, kMaxAxes> fractions_;
  BlockOf<float> later_fractions_;  // on the axis of alternatives, at the later one
  BlockOf<float> zeros_;            // fractions of slots without an axis
};

}  // namespace albtpu
