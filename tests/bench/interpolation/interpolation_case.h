// What interpolators are timed on: tables of a size, pulses in an order.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tables/query/pulse_columns.h"
#include "tables/uncertainty_table.h"

namespace albtpu::bench {

// Six axes, all quantities with standard errors, values without any physics. `megabytes` is the size of four
// quantities in single precision: 5, 15 or 200.
UncertaintyTable TableOf(int megabytes);

enum class Order {
  // A flight line: the wind and the fetch stay, between nodes; lines of 1000 pulses sweep the incidence from
  // -20 to 20 degrees and back, each half at its own azimuth; the footprint follows, the depth changes slowly.
  kScan,
  kRandom,  // Each coordinate anywhere on its axis, uniformly or log-uniformly.
};

class PulseBatch {
 public:
  PulseBatch(const UncertaintyTable& table, Order order, std::size_t count, bool azimuth_absent = false);

  const PulseColumns& columns() const { return columns_; }

 private:
  void FlyLine(std::size_t count);
  void Scatter(const UncertaintyTable& table, std::size_t count);

  std::array<std::vector<float>, kAxisCount> numbers_;
  PulseColumns columns_;
};

}  // namespace albtpu::bench
