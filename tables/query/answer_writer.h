// From the numbers of a block to the columns of the caller: restated, not-a-number where there is none.
#pragma once

#include "tables/query/block_values.h"
#include "tables/query/node_records.h"
#include "tables/query/pulse_block.h"
#include "tables/query/pulse_columns.h"

namespace albtpu {

// All must outlive it.
class AnswerWriter {
 public:
  AnswerWriter(const Query& query, const NodeRecords& records, const AnswerColumns& answers);

  // What must be found for the columns that are wanted.
  const Needs& needs() const { return needs_; }

  void Write(const PulseBlock& block, const BlockValues& numbers) const;

 private:
  void WriteOutcomes(const PulseBlock& block) const;
  // `numbers` is null where the table has none.
  void WriteNumbers(const PulseBlock& block, Quantity quantity, const BlockOf<float>* numbers,
                    const BlockOf<double>& radius_over_thu, float* column) const;
  void WriteS44(const PulseBlock& block, const BlockValues& numbers) const;

  const Query& query_;
  const NodeRecords& records_;
  const AnswerColumns& answers_;
  bool s44_;
  Needs needs_;
};

}  // namespace albtpu
