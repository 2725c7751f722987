// Columns of pulses and of answers that own their memory.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

#include "tables/query/pulse_columns.h"

namespace albtpu::client {

class PulseMemory {
 public:
  // The coordinates are in the order of kAxes.
  void Add(const std::array<float, kAxisCount>& pulse) {
    for (std::size_t i = 0; i < kAxisCount; ++i) axes_[i].push_back(pulse[i]);
  }

  std::vector<float>& axis(AxisId axis) { return axes_[Index(axis)]; }
  std::size_t size() const { return axes_[Index(AxisId::kDepth)].size(); }
  PulseColumns columns() const {
    PulseColumns columns{.size = size(), .axis = {}};
    for (std::size_t i = 0; i < kAxisCount; ++i) columns.axis[i] = axes_[i];
    return columns;
  }

 private:
  std::array<std::vector<float>, kAxisCount> axes_;
};

// `count` pulses, each coordinate uniform in its range of `ranges`, in the order of kAxes.
inline PulseMemory RandomPulses(std::size_t count, const std::array<std::array<float, 2>, kAxisCount>& ranges) {
  std::mt19937 random(1);
  PulseMemory pulses;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<float, kAxisCount> pulse;
    for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
      const auto [from, to] = ranges[axis];
      pulse[axis] = from + (to - from) * static_cast<float>(random() >> 8) / static_cast<float>(1 << 24);
    }
    pulses.Add(pulse);
  }
  return pulses;
}

// Memory for every column that can be queried.
class AnswerMemory {
 public:
  explicit AnswerMemory(std::size_t count) : bytes_(3, Bytes(count)), floats_(14, Floats(count)) {}

  AnswerColumns columns() {
    AnswerColumns columns;
    columns.outcomes = bytes_[0].data();
    columns.outcome_axes = bytes_[1].data();
    columns.best_s44_orders = bytes_[2].data();
    for (std::size_t q = 0; q < kQuantityCount; ++q) {
      columns.values[q] = floats_[q].data();
      columns.standard_errors[q] = floats_[kQuantityCount + q].data();
    }
    columns.remaining_thu = floats_[12].data();
    columns.remaining_tvu = floats_[13].data();
    return columns;
  }

  // Compares bit for bit.
  bool operator==(const AnswerMemory& other) const {
    for (std::size_t i = 0; i < floats_.size(); ++i) {
      const std::size_t size = floats_[i].size() * sizeof(float);
      if (std::memcmp(floats_[i].data(), other.floats_[i].data(), size) != 0) return false;
    }
    return bytes_ == other.bytes_;
  }

 private:
  using Bytes = std::vector<std::uint8_t>;
  using Floats = std::vector<float>;

  std::vector<Bytes> bytes_;
  std::vector<Floats> floats_;
};

}  // namespace albtpu::client
