// Which table answers: a file, one of a server, or one of those that are installed beside the program.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "service/client/credentials.h"
#include "service/client/sea_sources.h"
#include "service/client/uncertainty_source.h"

namespace albtpu::client {

// At most one of `server` and `file` is set; without them an installed table answers in this process.
struct SourceOptions {
  std::string server = {};       // HOST:PORT
  Credentials credentials = {};  // for the server
  std::string file = {};         // FILE.h5
  std::string name = {};         // NAME or NAME/VERSION; empty for the default table
};

absl::StatusOr<std::unique_ptr<UncertaintySource>> OpenSource(const SourceOptions& options);

// Where seas are compiled: in this process, or on the server. UsageError if a table is named, too.
absl::StatusOr<std::unique_ptr<SeaSources>> OpenSeaSources(const SourceOptions& options);

// All tables of the source, or those that `options.name` names.
absl::StatusOr<std::vector<TableSummary>> ListTables(const SourceOptions& options);

}  // namespace albtpu::client
