// Tables from a smooth formula, for tests that need a table but not the sea: quick to make and always the same.
#pragma once

#include <string>

#include "tables/uncertainty_table.h"

namespace albtpu::testing {

struct SyntheticOptions {
  std::string id = "synthetic";
  std::string version = "1";
  double factor = 1;       // Multiplies every value and standard error: tables with different factors differ.
  bool published = false;  // Without biases and standard errors, like tables of published angles.
};

// Covers wind 3-10 m/s, fetch 1 km to fully developed (100 km), incidence 0-25 degrees, azimuth 0-90 degrees,
// footprint 0.25-2 m, depth 0-20 m. Values have the magnitude and the trends of the sea's, but are not true.
UncertaintyTable SyntheticTable(const SyntheticOptions& options = {});

// A table of one sea, whose waves cross: without a mirror, the same after half a turn. Nodes as above, azimuth 0-180
// degrees.
UncertaintyTable SyntheticSea();

// A table with one or two nodes on each axis, and with `scale` for every variable: small enough to check by hand.
UncertaintyTable TinyTable(Scale scale = Scale::kLinear, const TableSchema& kind = kSeaSurface);

// What a table is made of, for tests that change some of it.
struct TableParts {
  UncertaintyTable::Axes axes;
  UncertaintyTable::Variables variables;
  Provenance provenance;

  Variable& operator[](Quantity quantity) { return *variables[Index(quantity)]; }
  absl::StatusOr<UncertaintyTable> Create() const { return UncertaintyTable::Create(axes, variables, provenance); }
};
TableParts PartsOf(const UncertaintyTable& table);

// The axis of these nodes, which are rounded to single precision. The nodes must be valid.
Axis MakeAxis(AxisId id, const std::vector<double>& nodes, const TableSchema& kind = kSeaSurface);

}  // namespace albtpu::testing
