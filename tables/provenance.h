// The rules of Provenance: what may stand in the global attributes of a table.
#pragma once

#include "absl/status/status.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// InvalidArgument, naming the attribute, when a rule of `Provenance` is broken, when text is not UTF-8 or
// holds a NUL, or when the name of an attribute is not [A-Za-z_][A-Za-z0-9_]* or is reserved (format.h).
absl::Status CheckProvenance(const Provenance& provenance);

}  // namespace albtpu
