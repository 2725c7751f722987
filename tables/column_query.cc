#include "tables/column_query.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <thread>

#include "tables/answer_writer.h"
#include "tables/block_numbers.h"
#include "tables/pulse_block.h"
#include "tables/record_layout.h"

namespace albtpu {

struct ColumnInterpolator::Layout {
  explicit Layout(const UncertaintyTable& table) : grid(table), records(table) {}

  Grid grid;
  RecordLayout records;
};

ColumnInterpolator::ColumnInterpolator(const UncertaintyTable& table)
    : layout_(std::make_unique<const Layout>(table)) {}
ColumnInterpolator::~ColumnInterpolator() = default;
ColumnInterpolator::ColumnInterpolator(ColumnInterpolator&&) noexcept = default;
ColumnInterpolator& ColumnInterpolator::operator=(ColumnInterpolator&&) noexcept = default;

void ColumnInterpolator::Answer(const Query& query, const PulseColumns& pulses, std::size_t begin,
                                std::size_t end, const AnswerColumns& answers) const {
  assert(CheckLengths(pulses).ok() && begin <= end && end <= pulses.size);
  if (begin == end) return;
  const AnswerWriter writer(query, layout_->records, answers);
  PulseBlock block(layout_->grid, pulses, std::min(kBlock, end - begin));
  BlockNumbers numbers(layout_->records, writer.needs());
  for (std::size_t first = begin; first < end; first += kBlock) {
    block.MoveTo(first, std::min(kBlock, end - first));
    numbers.Find(block);
    writer.Write(block, numbers);
  }
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
