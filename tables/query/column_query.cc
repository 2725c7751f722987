#include "tables/query/column_query.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <thread>

#include "tables/query/answer_writer.h"
#include "tables/query/block_values.h"
#include "tables/query/node_records.h"
#include "tables/query/pulse_block.h"
#include "tables/query/sorted_pulses.h"

namespace albtpu {

struct ColumnInterpolator::Layout {
  explicit Layout(const UncertaintyTable& table)
      : grid(table),
        records(table),
        fewest_to_sort(SortedPulses::Fewest(records.displacement.size() / kRecordSize)) {}

  // Answers block by block, to the end or to where `fewest` pulses or more are left and the last block was in no
  // order. Returns where it stopped.
  std::size_t AnswerBlocks(const Query& query, const PulseColumns& pulses, std::size_t begin, std::size_t end,
                           const AnswerColumns& answers, std::size_t fewest) const;

  Grid grid;
  NodeRecords records;
  std::size_t fewest_to_sort;
};

ColumnInterpolator::ColumnInterpolator(const UncertaintyTable& table)
    : layout_(std::make_unique<const Layout>(table)) {}
ColumnInterpolator::~ColumnInterpolator() = default;
ColumnInterpolator::ColumnInterpolator(ColumnInterpolator&&) noexcept = default;
ColumnInterpolator& ColumnInterpolator::operator=(ColumnInterpolator&&) noexcept = default;

void ColumnInterpolator::Answer(const Query& query, const PulseColumns& pulses, std::size_t begin,
                                std::size_t end, const AnswerColumns& answers) const {
  assert(CheckLengths(pulses).ok() && begin <= end && end <= pulses.size);
  std::size_t first = begin;
  while (true) {
    first = layout_->AnswerBlocks(query, pulses, first, end, answers, layout_->fewest_to_sort);
    if (first == end) return;
    // What follows pulses in no order is likely in no order either.
    const std::size_t count =
        std::min(end - first, SortedPulses::kMost) / AxisLookup::kPadding * AxisLookup::kPadding;
    SortedPulses sorted(layout_->grid, pulses, first, count, answers);
    layout_->AnswerBlocks(query, sorted.pulses(), 0, count, sorted.answers(), SortedPulses::kNever);
    sorted.CopyAnswers();
    first += count;
  }
}

std::size_t ColumnInterpolator::Layout::AnswerBlocks(const Query& query, const PulseColumns& pulses,
                                                     std::size_t begin, std::size_t end,
                                                     const AnswerColumns& answers, std::size_t fewest) const {
  if (begin == end) return end;
  const AnswerWriter writer(query, records, answers);
  PulseBlock block(grid, pulses, std::min(kBlock, end - begin));
  BlockValues numbers(records, writer.needs());
  while (begin < end) {
    block.MoveTo(begin, std::min(kBlock, end - begin));
    numbers.Find(block);
    writer.Write(block, numbers);
    begin += block.count();
    if (end - begin >= fewest && block.IsScattered()) break;
  }
  return begin;
}

void AnswerOnAllCores(const ColumnInterpolator& interpolator, const Query& query, const PulseColumns& pulses,
                      const AnswerColumns& answers) {
  constexpr std::size_t kGrain = 8192;  // pulses of one piece of work: some 100 us and more
  if (pulses.size < 4 * kGrain) return interpolator.Answer(query, pulses, 0, pulses.size, answers);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pulses.size, kGrain), [&](const auto& range) {
    interpolator.Answer(query, pulses, range.begin(), range.end(), answers);
    std::this_thread::yield();  // Who asks for one pulse waits for a piece, not for a slice of the system's.
  });
}

}  // namespace albtpu
