// A table of any kind laid out for speed, and the loop over pulses that its interpolators share.
#pragma once

#include <algorithm>
#include <cstddef>

#include "tables/query/block_values.h"
#include "tables/query/node_records.h"
#include "tables/query/pulse_block.h"
#include "tables/query/pulse_columns.h"
#include "tables/query/sorted_pulses.h"
#include "tables/table.h"

namespace albtpu {

// Immutable.
struct TableLayout {
  // The schema must outlive it, the table need not.
  explicit TableLayout(const Table& table);

  const TableSchema& schema;
  Grid grid;
  NodeRecords records;
  std::size_t fewest_to_sort;
};

// Interpolates the pulses from `begin` on, block by block. Stops at `end`, or after a scattered block if at least
// `fewest_to_sort` pulses follow it. Returns the index of the first pulse that it has not interpolated.
// `writer.needs()` are the sets of records to blend; `writer.Take(block, values)` takes what was found at each
// alternative, and `writer.Write(block, values)` writes the answers of a block.
template <typename Writer>
std::size_t InterpolateBlocks(const TableLayout& layout, const PulseColumns& pulses, std::size_t begin,
                              std::size_t end, std::size_t fewest_to_sort, Writer&& writer) {
  if (begin == end) return end;
  PulseBlock block(layout.grid, pulses, std::min(kBlock, end - begin));
  BlockValues values(layout.records, writer.needs());
  while (begin < end) {
    block.MoveTo(begin, std::min(kBlock, end - begin));
    for (std::size_t alternative = 0; alternative < block.alternatives(); ++alternative) {
      block.TakeAlternative(alternative);
      values.Find(block);
      writer.Take(block, values);
    }
    writer.Write(block, values);
    begin += block.count();
    if (end - begin >= fewest_to_sort && block.IsScattered()) break;
  }
  return begin;
}

// Interpolates the pulses from `begin` to `end` into the same rows of `answers`, sorting them on the way if that is
// faster. `make_writer(columns)` returns the writer that fills `columns`: `answers` for pulses in the order in which
// they come, columns of a SortedAnswers for pulses that are sorted.
template <typename Columns, typename MakeWriter>
void InterpolateColumns(const TableLayout& layout, const PulseColumns& pulses, std::size_t begin,
                        std::size_t end, const Columns& answers, const MakeWriter& make_writer) {
  while (true) {
    begin = InterpolateBlocks(layout, pulses, begin, end, layout.fewest_to_sort, make_writer(answers));
    if (begin == end) return;
    // The pulses after a scattered block are likely to be scattered, too.
    const std::size_t count =
        std::min(end - begin, SortedPulses::kMost) / AxisLookup::kPadding * AxisLookup::kPadding;
    const SortedPulses sorted(layout.grid, pulses, begin, count);
    SortedAnswers<Columns> sorted_answers(sorted, answers);
    InterpolateBlocks(layout, sorted.pulses(), 0, count, SortedPulses::kNever,
                      make_writer(sorted_answers.columns()));
    sorted_answers.CopyBack();
    begin += count;
  }
}

}  // namespace albtpu
