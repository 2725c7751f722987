// A table as the bytes of its file, and back. No file is touched.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "tables/table.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// The sealed file. The same table gives the same bytes.
absl::StatusOr<std::string> EncodeTable(const Table& table);
inline absl::StatusOr<std::string> EncodeTable(const UncertaintyTable& table) { return EncodeTable(table.table()); }

// Checks the seal first, then the kind, the schema, the values and the content digest. Without a schema, the table is
// of one of UncertaintyTable::kKinds.
absl::StatusOr<Table> DecodeTable(absl::string_view file, const TableSchema& schema);
absl::StatusOr<UncertaintyTable> DecodeTable(absl::string_view file);

}  // namespace albtpu
