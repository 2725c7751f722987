// Tables from a smooth formula, for tests that need a table and not the sea: made in a moment, the same every
// time.
#pragma once

#include <string>

#include "tables/uncertainty_table.h"

namespace albtpu::testing {

struct SyntheticOptions {
  std::string id = "synthetic";
  std::string version = "1";
  double factor = 1;       // On every value and standard error: tables of two factors can be told apart.
  bool published = false;  // Without biases and standard errors, as tables made of published angles are.
};

// Covers wind 3-10 m/s, fetch 1 km to fully developed (100 km), incidence 0-25 degrees, azimuth 0-90 degrees,
// footprint 0.25-2 m, depth 0-20 m. Values have the size and the trends of the sea's, but not its truth.
UncertaintyTable SyntheticTable(const SyntheticOptions& options = {});

// A table of two nodes an axis or one, in which `scale` is that of every variable: small enough to reason
// about.
UncertaintyTable TinyTable(Scale scale = Scale::kLinear);

// The axis of these nodes, which are rounded to single precision. The nodes must be valid.
Axis MakeAxis(AxisId id, const std::vector<double>& nodes);

}  // namespace albtpu::testing
