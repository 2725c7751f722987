// From the units of a campaign to a table, with node values that minimize the error of interpolation.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "generator/campaign/campaign.h"
#include "generator/campaign/unit.h"
#include "tables/schema.h"
#include "tables/table.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// Node values that minimize the error of interpolation between the nodes.

// Linear interpolation of a curved function is biased: by h^2 f'' / 8 in the middle of an interval of width h, by
// nothing at the nodes, by h^2 f'' / 12 in the mean. Lowering each node by h^2 f'' / 12 removes the mean error and
// spreads the rest over nodes and middles. The root mean square error falls from h^2 f'' / sqrt(120) to h^2 f'' /
// sqrt(720), to less than half, at the price of an error of h^2 f'' / 12 at the nodes themselves (quasi-interpolation
// by linear splines: Blu, Thevenaz and Unser (2004), doi:10.1109/TIP.2004.826093; Condat, Blu and Unser (2005)).
//
// For intervals of different widths h_- and h_+, with f'' from three nodes in the scale of the axis,
//     v_i -= f''_i (h_-^3 + h_+^3) / (12 (h_- + h_+)).
// Derivation: the error integrates to h^3 f'' / 12 over an interval. Half of it for each end of the interval, divided
// by the integral (h_- + h_+) / 2 of the node's linear spline, is the amount above.
//
// The first and the last node of an axis keep their values, because more pulses lie exactly there than between nodes:
// at nadir, along and across the wind, over a fully developed sea. So does the first wind above a calm: the curve
// between them is not that of the winds above. Axes are balanced one after the other: all with at
// least three nodes except depth, along which everything is nearly linear. A quantity that cannot be negative keeps at
// least half of each value.
//
// `values` are those of `quantity` over its axes, in the layout of a table.
void BalanceNodes(const UncertaintyTable::Axes& axes, Quantity quantity, std::vector<float>& values);

// Builds a table from the units of a campaign. The table is a function of the campaign and of the date in
// SOURCE_DATE_EPOCH alone; it does not matter who computed the units and in which order they are added.
class TableBuilder {
 public:
  explicit TableBuilder(const Campaign& campaign);  // must outlive the builder
  ~TableBuilder();
  TableBuilder(const TableBuilder&) = delete;
  TableBuilder& operator=(const TableBuilder&) = delete;

  // Adds a sealed unit; each of UnitsOf(campaign) is added once. Fails when the unit is damaged or was not made for
  // this campaign by this program on this instruction set (OpenUnit in unit.h).
  absl::Status Add(UnitId unit, std::string_view bytes);

  // Requires that all units were added. Call it once.
  absl::StatusOr<Table> Build();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace albtpu
