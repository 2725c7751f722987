// A table on disk: HDF5 behind a user block that seals it. FORMAT.md is the specification.
#pragma once

#include <filesystem>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "tables/file/existing.h"
#include "tables/table.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// Reads a table of the sea surface and checks everything: first the seal, so that HDF5 never sees a file whose
// bytes have changed, then the schema, the values and the content digest. NotFound: there is no such file.
// DataLoss: it is truncated, damaged or not a table file. InvalidArgument: the seal is intact, but the content is
// not a valid table of the sea surface. Messages begin with the path.
absl::StatusOr<UncertaintyTable> ReadTable(const std::filesystem::path& path);

// The same for a table of the kind that `schema`, which must outlive the table, describes. InvalidArgument, too, if
// the file is of another kind.
absl::StatusOr<Table> ReadTable(const std::filesystem::path& path, const TableSchema& schema);

// Writes to a temporary name in the same folder, syncs and renames, so that `path` never holds half a table. The same
// table gives the same bytes. AlreadyExists if `path` exists and is to be kept; otherwise the error of the system.
absl::Status WriteTable(const UncertaintyTable& table, const std::filesystem::path& path, Existing existing);
absl::Status WriteTable(const Table& table, const std::filesystem::path& path, Existing existing);

}  // namespace albtpu
