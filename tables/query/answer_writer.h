// From the numbers of a block to the answers of a query: restated to its coverage, compared with S-44, NaN where
// there is no number.
#pragma once

#include "tables/query/block_values.h"
#include "tables/query/node_records.h"
#include "tables/query/pulse_block.h"
#include "tables/query/pulse_columns.h"

namespace albtpu {

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
  void WriteNumbers(const PulseBlock& block, Quantity quantity, const BlockOf<float>* numbers,
                    float* column) const;
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
