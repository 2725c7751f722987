// Pulses in random order, sorted so that neighbours read the same part of a table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>

#include "tables/query/pulse_block.h"
#include "tables/query/pulse_columns.h"

namespace albtpu {

class SortedPulses {
 public:
  // The maximum number of pulses that are sorted at a time: a column of them stays in the second-level cache. With
  // their answers they take at most some 100 bytes a pulse.
  static constexpr std::size_t kMost = std::size_t{1} << 16;

  // The number of pulses in random order from which on sorting is faster, for a table of this many records: at most
  // kMost, or kNever.
  static std::size_t Fewest(std::size_t records);
  static constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();

  // Sorts the `count` pulses from `begin` on; `count` is a multiple of AxisLookup::kPadding. Constant columns are not
  // copied.
  SortedPulses(const Grid& grid, const PulseColumns& pulses, std::size_t begin, std::size_t count);

  const PulseColumns& pulses() const { return pulses_; }
  std::size_t begin() const { return begin_; }
  std::size_t count() const { return count_; }
  // The place among the sorted pulses of the pulse `begin() + i`.
  std::size_t place(std::size_t i) const { return places_[i]; }

 private:
  void FindPlaces(const Grid& grid, const PulseColumns& pulses);
  void Sort(const Grid& grid, const PulseColumns& pulses);

  const std::size_t begin_, count_;
  std::unique_ptr<std::uint32_t[]> places_;
  std::unique_ptr<float[]> coordinates_;
  PulseColumns pulses_;
};

// Columns for the answers to sorted pulses. `Columns` is a struct of pointers with a function ForEachColumn(wanted,
// other, visit), which calls `visit` with each column that is not null and the same column of the other struct.
template <typename Columns>
class SortedAnswers {
 public:
  // Both must outlive it.
  SortedAnswers(const SortedPulses& pulses, const Columns& wanted) : pulses_(pulses), wanted_(wanted) {
    // All columns are aligned: the count is a multiple of eight.
    std::size_t bytes = 0;
    ForEachColumn(wanted_, columns_, [&](auto* column, auto*&) { bytes += pulses_.count() * sizeof(*column); });
    memory_ = std::make_unique_for_overwrite<std::byte[]>(bytes);
    std::byte* next = memory_.get();
    ForEachColumn(wanted_, columns_, [&](auto* column, auto*& sorted) {
      sorted = reinterpret_cast<decltype(column)>(next);
      next += pulses_.count() * sizeof(*column);
    });
  }

  const Columns& columns() const { return columns_; }

  // Copies the answers into the wanted columns, in the order of the pulses before they were sorted.
  void CopyBack() {
    ForEachColumn(wanted_, columns_, [&](auto* column, auto*& sorted) {
      for (std::size_t i = 0; i < pulses_.count(); ++i) column[pulses_.begin() + i] = sorted[pulses_.place(i)];
    });
  }

 private:
  const SortedPulses& pulses_;
  const Columns& wanted_;
  Columns columns_;
  std::unique_ptr<std::byte[]> memory_;
};

}  // namespace albtpu
