// A table as the bytes of its file, and back. No file is touched.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// The sealed file. The same table gives the same bytes.
absl::StatusOr<std::string> EncodeTable(const UncertaintyTable& table);

// Checks the seal, then the schema, the values and the content digest.
absl::StatusOr<UncertaintyTable> DecodeTable(absl::string_view file);

}  // namespace albtpu
