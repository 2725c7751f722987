// The pulses of a scanner and memory for their answers, for the benchmarks of the service.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tables/query/column_query.h"

namespace albtpu::bench {

// The quantities of a query: both refractions, THU and TVU.
inline constexpr std::size_t kAskedQuantities = 4;

// The pulses of a circular scan, 400 for each turn, over a sloping, rough bottom: one wind over a fully developed sea;
// incidence, azimuth, footprint and depth of each pulse. All are within the table `survey`.
class FlightLine {
 public:
  explicit FlightLine(std::size_t pulse_count);

  std::size_t size() const { return depth_.size(); }
  PulseColumns pulses() const { return pulses(0, size()); }
  PulseColumns pulses(std::size_t begin, std::size_t count) const;

 private:
  float wind_speed_ = 6.5f;
  std::vector<float> incidence_, azimuth_, footprint_, depth_;
};

class AnswerMemory {
 public:
  explicit AnswerMemory(std::size_t pulse_count);

  AnswerColumns columns(std::size_t begin = 0);  // from this pulse on
  // Ends the program with a message unless all answers equal those of `expected` bit by bit.
  void ExpectSame(const AnswerMemory& expected) const;

 private:
  std::vector<std::uint8_t> outcomes_, axes_;
  std::array<std::vector<float>, kAskedQuantities> values_;
};

}  // namespace albtpu::bench
