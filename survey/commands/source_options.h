// Which table answers: a file, a server, or the tables that are installed beside the program.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "service/client/credentials.h"
#include "service/client/uncertainty_source.h"

namespace albtpu::client {

// At most one of `server` and `file` is set. Neither: the installed tables, in this process.
struct SourceOptions {
  std::string server = {};       // HOST:PORT
  Credentials credentials = {};  // For it.
  std::string file = {};         // FILE.h5
  std::string name = {};         // NAME or NAME/VERSION among several; empty: the default.
};

absl::StatusOr<std::unique_ptr<UncertaintySource>> OpenSource(const SourceOptions& options);

// All tables that could be asked for there, or the one that is named.
absl::StatusOr<std::vector<TableSummary>> ListTables(const SourceOptions& options);

}  // namespace albtpu::client
