// The values and standard errors of a block of pulses: the records that they are blended from, and the answers that are
// stated and written of them.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tables/query/pulse_block.h"
#include "tables/query/pulse_columns.h"
#include "tables/query/record_blend.h"
#include "tables/table.h"

namespace albtpu {

// The numbers of a table, laid out to be blended.

// The place of the values or the standard errors of a quantity.
struct RecordPlace {
  std::size_t set = 0;   // index into NodeRecords::sets
  std::size_t lane = 0;  // which of the 4 numbers of a record
};

// Quantities over all axes and quantities over all but the last have sets of their own. Up to two quantities fit into
// one set together with their standard errors. If there are more, their values fill sets of four, and so do their
// standard errors. Numbers that a table does not hold are 0 here.
struct NodeRecords {
  explicit NodeRecords(const Table& table);

  // The maximum number of sets of a table: three quantities over one number of axes, six over the other.
  static constexpr std::size_t kMaxSets = 6;
  static_assert(kMaxQuantities == 9 && kRecordSize == 4);

  struct Set {
    bool over_last_axis;
    Records numbers;  // Of a variable on a log scale, the logarithms of its values.
    Records plain;    // The values as the table holds them, if any of `numbers` is a logarithm; else empty.
  };
  std::vector<Set> sets;
  std::size_t quantity_count;
  std::array<RecordPlace, kMaxQuantities> values, standard_errors;
  std::array<bool, kMaxQuantities> has_values{}, has_standard_errors{}, is_log{};

 private:
  // Puts values and standard errors of a quantity into a batch of records, beginning with the record `first`.
  void PutAll(const Table& table, std::size_t quantity, std::size_t first);
};

// The sets of records that have to be blended.
struct Needs {
  std::array<bool, NodeRecords::kMaxSets> sets{};

  void AddValue(const NodeRecords& records, std::size_t quantity) { sets[records.values[quantity].set] = true; }
  // The value included: the larger value decides which standard error belongs to it.
  void AddStandardError(const NodeRecords& records, std::size_t quantity) {
    AddValue(records, quantity);
    sets[records.standard_errors[quantity].set] = true;
  }
};

// The values and standard errors of a block of pulses, before they are restated and written.

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
  const BlockOf<float>& value(std::size_t quantity) const { return Column(largest_, records_.values[quantity]); }
  const BlockOf<float>& standard_error(std::size_t quantity) const {
    return Column(largest_, records_.standard_errors[quantity]);
  }

  // That of a later alternative, which Find() found last.
  const BlockOf<float>& later_value(std::size_t quantity) const { return Column(later_, records_.values[quantity]); }

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

// From the numbers of a block to the answers of a query: restated to its coverage, compared with S-44, NaN where
// there is no number.

// Writes the outcomes of a block and the axes that caused them; null for what is not wanted.
void WriteOutcomes(const PulseBlock& block, std::uint8_t* outcomes, std::uint8_t* outcome_axes);

// Writes NaN where a pulse of the block has no number.
void ClearOutside(const PulseBlock& block, float* column);

// Of a table of the sea surface. All arguments must outlive it.
class AnswerWriter {
 public:
  AnswerWriter(const Query& query, const NodeRecords& records, const AnswerColumns& answers);

  // The sets of records that the wanted columns need.
  const Needs& needs() const { return needs_; }

  // Takes the values at the current alternative of the block.
  void Take(const PulseBlock& block, BlockValues& values);

  // Call it when all alternatives are taken.
  void Write(const PulseBlock& block, const BlockValues& values) const;

 private:
  void TakeRadius(const PulseBlock& block, const BlockValues& values);
  // `numbers` is null if the table has none.
  void WriteNumbers(const PulseBlock& block, Quantity quantity, const BlockOf<float>* numbers, float* column) const;
  void WriteS44(const PulseBlock& block, const BlockValues& values) const;

  const Query& query_;
  const NodeRecords& records_;
  const AnswerColumns& answers_;
  bool s44_;
  bool needs_radius_ = false;
  Needs needs_;
  BlockOf<double> radius_over_thu_;  // the largest 95 % radius of the horizontal error over the largest THU
};

}  // namespace albtpu
