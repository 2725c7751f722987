// A source that queries a server.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "service/client/credentials.h"
#include "service/client/patience.h"
#include "service/client/uncertainty_source.h"

namespace albtpu::client {

// Opens a source that queries the server in columns: each message holds the maximum number of pulses, and several
// messages are sent ahead of the answers. The table is fixed when the source is opened, and every answer must come from
// the same content.
//
// `address` is HOST:PORT, or `dns:///NAME:PORT` for a name with several servers: calls of Answer take turns with them,
// and another server answers what a failed one left unanswered. `table` is the name of the table; empty selects the
// server's default. Answers are for water of the index; a server before version 0.2 answers at the index of its table.
// Opening fails within one second if the server refuses connections, and within six if it does not
// respond.
//
// Example:
//   const auto server = OpenServer("127.0.0.1:50051", "");
//   if (!server.ok()) return server.status();
//   absl::Status status = (*server)->Answer({.coverage = Coverage::kP95}, pulses, answers);
// where `pulses` and `answers` are as in the example in column_query.h.
absl::StatusOr<std::unique_ptr<UncertaintySource>> OpenServer(const std::string& address, const std::string& table,
                                                              const Patience& patience = {},
                                                              const Credentials& credentials = {},
                                                              double index = kSeaWaterIndex);

// Lists all tables of a server.
absl::StatusOr<std::vector<TableSummary>> ListServerTables(const std::string& address,
                                                           const Credentials& credentials = {});

}  // namespace albtpu::client
