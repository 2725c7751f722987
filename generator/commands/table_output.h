// The file that a command makes a table in.
#pragma once

#include <filesystem>

#include "absl/status/status.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// What would keep the table from being written is looked for before the work.
absl::Status CheckOutput(const std::filesystem::path& output, bool overwrite);

// Writes the table, and says on standard output what it is.
absl::Status Publish(const UncertaintyTable& table, const std::filesystem::path& output, bool overwrite);

}  // namespace albtpu
