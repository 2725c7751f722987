// The table file that a command writes.
#pragma once

#include <filesystem>

#include "absl/status/status.h"
#include "tables/table.h"

namespace albtpu::programs {

// Checks, before the computation, that the table can be written.
absl::Status CheckOutput(const std::filesystem::path& output, bool overwrite);

// Writes the table. Prints its id, version, digest and interpolation errors on standard output, and a warning on
// standard error if they are large.
absl::Status Publish(const Table& table, const std::filesystem::path& output, bool overwrite);

}  // namespace albtpu::programs
