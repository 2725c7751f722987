// A table as the bytes of its file, and back. No file is touched.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// The sealed file. The same table gives the same bytes.
absl::StatusOr<std::string> EncodeTable(const UncertaintyTable& table);

// Checks the seal, then the schema, the values and the content digest. `file` is not changed, but HDF5 wants
// it not const.
absl::StatusOr<UncertaintyTable> DecodeTable(std::string& file);

}  // namespace albtpu
