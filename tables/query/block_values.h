// The values and standard errors of a block of pulses, before they are restated and written.
#pragma once

#include <array>
#include <cstddef>

#include "tables/query/block.h"
#include "tables/query/node_records.h"
#include "tables/query/pulse_block.h"

namespace albtpu {

// The sets of records that have to be blended.
struct Needs {
  std::array<bool, NodeRecords::kMaxSets> sets{};

  void AddValue(const NodeRecords& records, std::size_t quantity) {
    sets[records.values[quantity].set] = true;
  }
  // The value included: the larger value decides which standard error belongs to it.
  void AddStandardError(const NodeRecords& records, std::size_t quantity) {
    AddValue(records, quantity);
    sets[records.standard_errors[quantity].set] = true;
  }
};

// At 2 sigma. Numbers of pulses that are outside the table, and numbers that the table does not hold, are undefined.
class BlockValues {
 public:
  BlockValues(const NodeRecords& records, const Needs& needs) : records_(records), needs_(needs) {}

  // At the alternative that the block is at.
  void Find(const PulseBlock& block);

  // Takes each value of that alternative that is larger in magnitude than those of the ones before, and the standard
  // error that belongs to it.
  void TakeLarger(const PulseBlock& block);

  // The largest values taken; without TakeLarger(), those of the first alternative.
  const BlockOf<float>& value(std::size_t quantity) const {
    return Column(largest_, records_.values[quantity]);
  }
  const BlockOf<float>& standard_error(std::size_t quantity) const {
    return Column(largest_, records_.standard_errors[quantity]);
  }

  // That of a later alternative, which Find() found last.
  const BlockOf<float>& later_value(std::size_t quantity) const {
    return Column(later_, records_.values[quantity]);
  }

 private:
  using Columns = std::array<std::array<BlockOf<float>, kRecordSize>, NodeRecords::kMaxSets>;

  static const BlockOf<float>& Column(const Columns& columns, const RecordPlace& place) {
    return columns[place.set][place.lane];
  }
  void TakeExponentials(const BlendedPulses& pulses, std::size_t set, Columns& columns) const;

  const NodeRecords& records_;
  const Needs needs_;
  BlockOf<float> blended_[kRecordSize];  // as consecutive records
  Columns largest_;
  // Unused. Without it, `largest_` and `later_` would be a multiple of 4096 bytes apart, and processors delay a load
  // after a store to an address with the same last 12 bits.
  [[maybe_unused]] BlockOf<float> gap_[2];
  Columns later_;
};

}  // namespace albtpu
