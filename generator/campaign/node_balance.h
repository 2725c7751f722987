// Node values that make interpolation between nodes as good as it can be.
#pragma once

#include <vector>

#include "tables/schema.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// Linear interpolation of a curved function errs to one side: by h^2 f'' / 8 amid an interval of width h, by
// nothing at the nodes. Lowering each node by a twelfth of h^2 f'' takes the mean of the error away and spreads
// the rest over nodes and middles: half as large in the root mean square, at the price of an error of
// h^2 f'' / 12 at the nodes themselves (quasi-interpolation by linear splines: Blu, Thevenaz and Unser (2004),
// doi:10.1109/TIP.2004.826093; Condat, Blu and Unser (2005)). Between intervals of different widths, with f'' by
// three nodes in the scale of the axis,
//     v_i -= f''_i (h_-^3 + h_+^3) / (12 (h_- + h_+)).
// The first and the last node of an axis stay as they are: at nadir, along and across the wind and over a fully
// developed sea more pulses lie than between nodes. One axis after another: all that have three nodes but depth,
// in which everything is nearly linear. A quantity that is not negative keeps at least half of each value.
//
// `values` are of `quantity` over its axes, as in a table.
void BalanceNodes(const UncertaintyTable::Axes& axes, Quantity quantity, std::vector<float>& values);

}  // namespace albtpu
