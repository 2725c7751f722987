#include "tables/query/column_query.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <thread>

#include "tables/query/block_values.h"
#include "tables/query/pulse_block.h"
#include "tables/query/sorted_pulses.h"

namespace albtpu {

// Immutable. The schema of the table must outlive it, the table need not.
struct ColumnInterpolator::Layout {
  explicit Layout(const Table& table)
      : schema(table.schema()),
        grid(table),
        records(table),
        fewest_to_sort(SortedPulses::Fewest(RecordCount(records))) {}

  const TableSchema& schema;
  Grid grid;
  NodeRecords records;
  std::size_t fewest_to_sort;

 private:
  static std::size_t RecordCount(const NodeRecords& records) {
    std::size_t largest = 0;
    for (const NodeRecords::Set& set : records.sets) largest = std::max(largest, set.numbers.size());
    return largest / kRecordSize;
  }
};

ColumnInterpolator::ColumnInterpolator(const UncertaintyTable& table)
    : layout_(std::make_unique<const Layout>(table.table())) {}
ColumnInterpolator::~ColumnInterpolator() = default;
ColumnInterpolator::ColumnInterpolator(ColumnInterpolator&&) noexcept = default;
ColumnInterpolator& ColumnInterpolator::operator=(ColumnInterpolator&&) noexcept = default;

template <typename Visit>
void ForEachColumn(const AnswerColumns& wanted, AnswerColumns& other, const Visit& visit) {
  const auto visit_if_wanted = [&](auto* column, auto*& same) {
    if (column != nullptr) visit(column, same);
  };
  for (std::size_t q = 0; q < kQuantityCount; ++q) {
    visit_if_wanted(wanted.values[q], other.values[q]);
    visit_if_wanted(wanted.standard_errors[q], other.standard_errors[q]);
  }
  visit_if_wanted(wanted.remaining_thu, other.remaining_thu);
  visit_if_wanted(wanted.remaining_tvu, other.remaining_tvu);
  visit_if_wanted(wanted.outcomes, other.outcomes);
  visit_if_wanted(wanted.outcome_axes, other.outcome_axes);
  visit_if_wanted(wanted.best_s44_orders, other.best_s44_orders);
}

// Interpolates the pulses from `begin` on, block by block. Stops at `end`, or after a scattered block if at least
// `fewest_to_sort` pulses follow it. Returns the index of the first pulse that it has not interpolated.
template <typename Layout>
std::size_t InterpolateBlocks(const Layout& layout, const PulseColumns& pulses, std::size_t begin, std::size_t end,
                              std::size_t fewest_to_sort, AnswerWriter&& writer) {
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

void ColumnInterpolator::Interpolate(const Query& query, const PulseColumns& pulses, std::size_t begin, std::size_t end,
                                     const AnswerColumns& answers) const {
  assert(CheckLengths(layout_->schema, pulses).ok() && begin <= end && end <= pulses.size);
  while (true) {
    begin = InterpolateBlocks(*layout_, pulses, begin, end, layout_->fewest_to_sort,
                              AnswerWriter(query, layout_->records, answers));
    if (begin == end) return;
    // The pulses after a scattered block are likely to be scattered, too.
    const std::size_t count = std::min(end - begin, SortedPulses::kMost) / AxisLookup::kPadding * AxisLookup::kPadding;
    const SortedPulses sorted(layout_->grid, pulses, begin, count);
    SortedAnswers<AnswerColumns> sorted_answers(sorted, answers);
    InterpolateBlocks(*layout_, sorted.pulses(), 0, count, SortedPulses::kNever,
                      AnswerWriter(query, layout_->records, sorted_answers.columns()));
    sorted_answers.CopyBack();
    begin += count;
  }
}

void InterpolateOnAllCores(const ColumnInterpolator& interpolator, const Query& query, const PulseColumns& pulses,
                           const AnswerColumns& answers) {
  constexpr std::size_t kGrain = 8192;  // pulses in a piece of work, which takes at least 100 us
  if (pulses.size < 4 * kGrain) return interpolator.Interpolate(query, pulses, 0, pulses.size, answers);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pulses.size, kGrain), [&](const auto& range) {
    interpolator.Interpolate(query, pulses, range.begin(), range.end(), answers);
    // A query for a single pulse waits for one piece of work, not for a time slice of the system.
    std::this_thread::yield();
  });
}

}  // namespace albtpu
