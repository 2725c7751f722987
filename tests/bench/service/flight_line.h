// Pulses as a scanner sends them, and room for their answers: what the benchmarks of the service ask for.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tables/query/column_query.h"

namespace albtpu::bench {

// The columns that are asked for: both refractions, THU and TVU.
inline constexpr std::size_t kAskedQuantities = 4;

// One wind for all, a fully developed sea; incidence, azimuth, footprint and depth of each pulse, in the
// order of a circular scan of 400 pulses over a sloping, rough bottom. All within the table `survey`.
class FlightLine {
 public:
  explicit FlightLine(std::size_t pulse_count);

  std::size_t size() const { return depth_.size(); }
  PulseColumns pulses() const { return pulses(0, size()); }
  PulseColumns pulses(std::size_t begin, std::size_t count) const;  // Some of them.

 private:
  float wind_speed_ = 6.5f;
  std::vector<float> incidence_, azimuth_, footprint_, depth_;
};

class AnswerMemory {
 public:
  explicit AnswerMemory(std::size_t pulse_count);

  AnswerColumns columns(std::size_t begin = 0);  // From this pulse on.
  // Ends the program, saying where, unless all answers are those of `expected`, bit by bit.
  void ExpectSame(const AnswerMemory& expected) const;

 private:
  std::vector<std::uint8_t> outcomes_, axes_;
  std::array<std::vector<float>, kAskedQuantities> values_;
};

}  // namespace albtpu::bench
