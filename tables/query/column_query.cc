#include "tables/query/column_query.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cassert>
#include <thread>

#include "tables/query/answer_writer.h"
#include "tables/query/table_layout.h"

namespace albtpu {

struct ColumnInterpolator::Layout : TableLayout {
  using TableLayout::TableLayout;
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

void ColumnInterpolator::Interpolate(const Query& query, const PulseColumns& pulses, std::size_t begin,
                                     std::size_t end, const AnswerColumns& answers) const {
  assert(CheckLengths(layout_->schema, pulses).ok() && begin <= end && end <= pulses.size);
  InterpolateColumns(*layout_, pulses, begin, end, answers, [&](const AnswerColumns& columns) {
    return AnswerWriter(query, layout_->records, columns);
  });
}

void InterpolateOnAllCores(const ColumnInterpolator& interpolator, const Query& query,
                           const PulseColumns& pulses, const AnswerColumns& answers) {
  constexpr std::size_t kGrain = 8192;  // pulses in a piece of work, which takes at least 100 us
  if (pulses.size < 4 * kGrain) return interpolator.Interpolate(query, pulses, 0, pulses.size, answers);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pulses.size, kGrain), [&](const auto& range) {
    interpolator.Interpolate(query, pulses, range.begin(), range.end(), answers);
    // A query for a single pulse waits for one piece of work, not for a time slice of the system.
    std::this_thread::yield();
  });
}

}  // namespace albtpu
