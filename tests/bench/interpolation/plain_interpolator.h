// Straightforward interpolation of a table in scalar double precision: the peers of ColumnInterpolator.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tables/query/pulse_columns.h"
#include "tables/uncertainty_table.h"

namespace albtpu::bench {

// The layout of the quantities in memory.
enum class Quantities {
  kApart,       // one array for each, in the table's single precision
  kSideBySide,  // at each node, in double precision
};

// Multilinear interpolation of THU, TVU and both biases. Nodes are found by binary search; index and weight of each
// corner are computed once for all four quantities. There are no outcomes: pulses must be inside the domain and have an
// azimuth from 0 to 90 degrees.
template <Quantities kLayout>
class PlainInterpolator {
 public:
  static constexpr std::size_t kQuantities = 4;

  explicit PlainInterpolator(const UncertaintyTable& table);

  // Writes `kQuantities` columns.
  void Answer(const PulseColumns& pulses, std::size_t begin, std::size_t end,
              const std::array<float*, kQuantities>& answers) const;

 private:
  struct PlainAxis {
    std::vector<double> nodes;  // or their logarithms
    bool log;
    std::size_t step;  // to the next node, in nodes
  };

  std::array<PlainAxis, kAxisCount> axes_;
  std::array<std::vector<float>, kQuantities> apart_;
  std::vector<double> side_by_side_;
};

}  // namespace albtpu::bench
