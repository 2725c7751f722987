// A table on disk: HDF5 behind a user block that seals it. FORMAT.md is the specification.
#pragma once

#include <filesystem>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "tables/file/existing.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// Reads and checks everything: the seal first (HDF5 never sees a file whose bytes changed), then the schema,
// then the values and the content digest. NotFound: no such file. DataLoss: truncated, foreign or damaged.
// InvalidArgument: a sealed file that is not a valid table. Messages begin with the path.
absl::StatusOr<UncertaintyTable> ReadTable(const std::filesystem::path& path);

// Writes to a temporary name in the same folder, syncs, and renames: there is never half a table under
// `path`. The same table gives the same bytes. AlreadyExists when `path` exists and is to be kept; otherwise
// the reason of the system.
absl::Status WriteTable(const UncertaintyTable& table, const std::filesystem::path& path, Existing existing);

}  // namespace albtpu
