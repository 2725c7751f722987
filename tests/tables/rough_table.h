// Tables of random axes and random values: whatever holds of their answers does not hold because the sea is
// smooth.
#pragma once

#include <cstdint>

#include "tables/uncertainty_table.h"

namespace albtpu::testing {

// One to six nodes an axis, unevenly spaced, azimuth from 0 to 90 degrees. Uncertainties lie between 0.001
// and 1, biases between -1 and 1. `scale` is that of uncertainties and of standard errors never. The same
// every time.
UncertaintyTable RoughTable(std::uint32_t seed, Scale scale = Scale::kLinear);

// The values of a quantity at the nodes around a pulse in the domain; those of its standard error. Without an
// azimuth it is that of 0 degrees.
struct Corners {
  std::vector<float> values, standard_errors;
};
Corners CornersAround(const UncertaintyTable& table, Quantity quantity,
                      const std::array<float, kAxisCount>& at);

}  // namespace albtpu::testing
