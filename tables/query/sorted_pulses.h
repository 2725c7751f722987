// Pulses in no order, sorted so that neighbours read the same part of a table.
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
  // At most so many at a time: a column of them stays in the second cache while it is sorted. With their answers
  // they take some 100 bytes a pulse at the most.
  static constexpr std::size_t kMost = std::size_t{1} << 16;

  // From how many pulses in no order on it is faster to sort them, in a table of so many records: kMost or fewer, or
  // kNever.
  static std::size_t Fewest(std::size_t records);
  static constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();

  // The pulses `begin` to `begin + count`, the latter not included, and room for the answers that are wanted.
  // `count` is a multiple of AxisLookup::kPadding. Constant columns stay where they are.
  SortedPulses(const Grid& grid, const PulseColumns& pulses, std::size_t begin, std::size_t count,
               const AnswerColumns& wanted);

  // Both in the order of the sorted pulses.
  const PulseColumns& pulses() const { return pulses_; }
  const AnswerColumns& answers() const { return answers_; }

  // Copies the answers to where they were wanted.
  void CopyAnswers();

 private:
  void FindPlaces(const Grid& grid, const PulseColumns& pulses);
  void Sort(const PulseColumns& pulses);
  void MakeRoom();

  const std::size_t begin_, count_;
  const AnswerColumns wanted_;
  std::unique_ptr<std::uint32_t[]> places_;  // of each pulse among the sorted
  std::unique_ptr<float[]> coordinates_;
  std::unique_ptr<std::byte[]> room_;  // for answers
  PulseColumns pulses_;
  AnswerColumns answers_;
};

}  // namespace albtpu
