#include "tables/query/sorted_pulses.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>
#include <vector>

namespace albtpu {
namespace {

// Calls `visit` with each column that is wanted, and the same column of `beside`.
template <typename Visit>
void ForEachWanted(const AnswerColumns& wanted, AnswerColumns& beside, const Visit& visit) {
  const auto visit_if_wanted = [&](auto* column, auto*& other) {
    if (column != nullptr) visit(column, other);
  };
  for (std::size_t q = 0; q < kQuantityCount; ++q) {
    visit_if_wanted(wanted.values[q], beside.values[q]);
    visit_if_wanted(wanted.standard_errors[q], beside.standard_errors[q]);
  }
  visit_if_wanted(wanted.remaining_thu, beside.remaining_thu);
  visit_if_wanted(wanted.remaining_tvu, beside.remaining_tvu);
  visit_if_wanted(wanted.outcomes, beside.outcomes);
  visit_if_wanted(wanted.outcome_axes, beside.outcome_axes);
  visit_if_wanted(wanted.best_s44_orders, beside.best_s44_orders);
}

}  // namespace

// To sort takes an eighth of the time of answers in no order. It pays where a table does not stay in the second cache,
// records of 16 bytes, and where pulses, each of which reads 64 records, read as many as half of the table has: with
// fewer, what neighbours share is seldom still there (interpolation_bench).
std::size_t SortedPulses::Fewest(std::size_t records) {
  constexpr std::size_t kRecordsInCache = 1 << 16, kRecordsAPulse = 128;
  const std::size_t fewest = records / kRecordsAPulse;
  return records <= kRecordsInCache || fewest > kMost ? kNever : fewest;
}

SortedPulses::SortedPulses(const Grid& grid, const PulseColumns& pulses, std::size_t begin, std::size_t count,
                           const AnswerColumns& wanted)
    : begin_(begin), count_(count), wanted_(wanted) {
  assert(count > 0 && count <= kMost && count % AxisLookup::kPadding == 0);
  FindPlaces(grid, pulses);
  Sort(pulses);
  MakeRoom();
}

// By the cell that a pulse is in, its depth left out: all depths of a cell take few lines of the cache. A counting
// sort; where there are many cells, neighbours share a count.
void SortedPulses::FindPlaces(const Grid& grid, const PulseColumns& pulses) {
  constexpr std::int32_t kMostCounts = 1 << 14;
  std::vector<std::int32_t> rows(count_);
  for (AxisId axis : kAxes) {
    if (axis == AxisId::kDepth || pulses[axis].size() <= 1) continue;
    grid.axis(axis).AddLowerNodes(pulses[axis].data() + begin_, count_,
                                  static_cast<std::int32_t>(grid.step(axis)), rows.data());
  }
  const std::int32_t last = *std::max_element(rows.begin(), rows.end());
  int shift = 0;
  while (last >> shift >= kMostCounts) ++shift;
  std::vector<std::uint32_t> counts(static_cast<std::size_t>(last >> shift) + 1);
  for (std::int32_t& row : rows) {
    row >>= shift;
    ++counts[static_cast<std::size_t>(row)];
  }
  std::uint32_t before = 0;
  for (std::uint32_t& count : counts) before += std::exchange(count, before);
  places_ = std::make_unique_for_overwrite<std::uint32_t[]>(count_);
  for (std::size_t i = 0; i < count_; ++i) places_[i] = counts[static_cast<std::size_t>(rows[i])]++;
}

void SortedPulses::Sort(const PulseColumns& pulses) {
  pulses_ = pulses;
  pulses_.size = count_;
  coordinates_ = std::make_unique_for_overwrite<float[]>(kAxisCount * count_);
  for (AxisId axis : kAxes) {
    if (pulses[axis].size() <= 1) continue;
    const float* from = pulses[axis].data() + begin_;
    float* to = coordinates_.get() + Index(axis) * count_;
    for (std::size_t i = 0; i < count_; ++i) to[places_[i]] = from[i];
    pulses_.axis[Index(axis)] = std::span(to, count_);
  }
}

// All are aligned: `count_` is a multiple of eight.
void SortedPulses::MakeRoom() {
  std::size_t bytes = 0;
  ForEachWanted(wanted_, answers_, [&](auto* wanted, auto*&) { bytes += count_ * sizeof(*wanted); });
  room_ = std::make_unique_for_overwrite<std::byte[]>(bytes);
  std::byte* next = room_.get();
  ForEachWanted(wanted_, answers_, [&](auto* wanted, auto*& sorted) {
    sorted = reinterpret_cast<decltype(wanted)>(next);
    next += count_ * sizeof(*wanted);
  });
}

void SortedPulses::CopyAnswers() {
  ForEachWanted(wanted_, answers_, [&](auto* wanted, auto*& sorted) {
    for (std::size_t i = 0; i < count_; ++i) wanted[begin_ + i] = sorted[places_[i]];
  });
}

}  // namespace albtpu
