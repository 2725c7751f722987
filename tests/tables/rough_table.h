// Tables of random axes and random values: properties of their answers do not depend on a smooth sea.
#pragma once

#include <cstdint>

#include "tables/uncertainty_table.h"

namespace albtpu::testing {

// One to six nodes an axis, unevenly spaced, azimuth from 0 to 90 degrees. Uncertainties lie between 0.001
// and 1, biases between -1 and 1. `scale` applies to the uncertainties only, never to standard errors. A seed
// always gives the same table.
UncertaintyTable RoughTable(std::uint32_t seed, Scale scale = Scale::kLinear);

// The values and the standard errors of a quantity at the nodes around a pulse in the domain.
struct Corners {
  std::vector<float> values, standard_errors;
};
Corners CornersAround(const UncertaintyTable& table, Quantity quantity, const std::array<float, kAxisCount>& at);

}  // namespace albtpu::testing
