// The input on which interpolators are timed: tables of a given size and pulses in a given order.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tables/query/pulse_columns.h"
#include "tables/uncertainty_table.h"

namespace albtpu::bench {

// A table with six axes and random values for all quantities and standard errors. `megabytes` is the size of four
// quantities in single precision: 5, 15 or 200.
UncertaintyTable TableOf(int megabytes);

enum class Order {
  // A flight line. Wind and fetch are constant, between nodes. Lines of 1000 pulses sweep the scan angle from -20 to 20
  // degrees and back, with a different azimuth on each side. The footprint follows the incidence; the depth changes
  // slowly.
  kScan,
  kRandom,  // All coordinates are random on their axes, uniform or log-uniform.
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
