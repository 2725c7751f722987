// Kinds of tables that are not the sea surface's, for tests of code that knows a kind by its schema alone.
#pragma once

#include <cstdint>
#include <vector>

#include "tables/table.h"

namespace albtpu::testing {

// Three axes, one with each rule for absent columns, and two quantities, of which the bias does not depend on the
// last axis.
extern const TableSchema kThreeAxes;
// As kThreeAxes, under another name.
extern const TableSchema kThreeAxesRenamed;
// As many axes and quantities as a table may have, in an unusual blend order.
extern const TableSchema kLargestKind;
// One axis and one quantity.
extern const TableSchema kOneAxis;

// A table of random values. Axes have `sizes` nodes, spaced unevenly; quantities that are not biases have `scale`.
Table RandomTable(const TableSchema& schema, const std::vector<std::size_t>& sizes, std::uint32_t seed,
                  Scale scale = Scale::kLinear, bool with_standard_errors = true);

}  // namespace albtpu::testing
