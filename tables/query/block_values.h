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

  // At both ends, if the block has two.
  void Find(const PulseBlock& block);

  // Of a block with two ends, takes at kLow each value that is larger in magnitude, and the standard error that
  // belongs to it.
  void TakeLarger(const PulseBlock& block);

  const BlockOf<float>& value(std::size_t quantity, End end = End::kLow) const {
    return column(records_.values[quantity], end);
  }
  const BlockOf<float>& standard_error(std::size_t quantity) const {
    return column(records_.standard_errors[quantity], End::kLow);
  }

 private:
  using Columns = std::array<std::array<BlockOf<float>, kRecordSize>, NodeRecords::kMaxSets>;

  const BlockOf<float>& column(const RecordPlace& place, End end) const {
    return (end == End::kLow ? low_ : high_)[place.set][place.lane];
  }
  void Find(const PulseBlock& block, End end, Columns& columns);
  void TakeExponentials(const BlendedPulses& pulses, std::size_t set, Columns& columns) const;

  const NodeRecords& records_;
  const Needs needs_;
  BlockOf<float> blended_[kRecordSize];  // as consecutive records
  Columns low_;
  // Unused. Without it, `low_` and `high_` would be a multiple of 4096 bytes apart, and processors delay a load after a
  // store to an address with the same last 12 bits.
  [[maybe_unused]] BlockOf<float> gap_[2];
  Columns high_;
};

}  // namespace albtpu
