// A table interpolated as one would by hand, in scalar double precision: the peer of ColumnInterpolator.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tables/pulse_columns.h"
#include "tables/uncertainty_table.h"

namespace albtpu::bench {

// THU, TVU and both biases, multilinear. Nodes are searched by halves, index and weight of each corner are
// found once for all four quantities, which stand side by side in double precision. No outcomes: pulses are
// inside the domain and have an azimuth of 0 to 90 degrees.
class PlainInterpolator {
 public:
  static constexpr std::size_t kQuantities = 4;

  explicit PlainInterpolator(const UncertaintyTable& table);

  // To `kQuantities` columns.
  void Answer(const PulseColumns& pulses, std::size_t begin, std::size_t end,
              const std::array<float*, kQuantities>& answers) const;

 private:
  struct PlainAxis {
    std::vector<double> nodes;  // or their logarithms
    bool log;
    std::size_t step;  // to the next node, in nodes
  };

  std::array<PlainAxis, kAxisCount> axes_;
  std::vector<double> values_;
};

}  // namespace albtpu::bench
