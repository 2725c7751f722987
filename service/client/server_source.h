// Answers from a service.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "service/client/credentials.h"
#include "service/client/uncertainty_source.h"

namespace albtpu::client {

// What is done about a server that goes away while it is asked: the same again, so many times, after pauses
// that double each time. The defaults wait 12.7 s. Every answer that comes starts the count anew.
struct Patience {
  int retries = 7;
  std::chrono::milliseconds first_pause{100};
};

// Asks in columns, so many pulses at a time as a message may hold, several messages ahead of the answers. The
// table is fixed when the source is opened: every answer must come from its content.
//
// `address` is HOST:PORT, or `dns:///NAME:PORT` where a name has several servers: calls of Answer take turns
// with them, and what one leaves unanswered when it goes is asked of another. `table` is what to ask for, empty
// for the server's default. One that refuses from the beginning is asked for less
// than a second, one that says nothing for six.
//
// Example:
//   const auto server = OpenServer("127.0.0.1:50051", "");
//   if (!server.ok()) return server.status();
//   absl::Status status = (*server)->Answer({.coverage = Coverage::kP95}, pulses, answers);
// with the columns of the example in column_query.h.
absl::StatusOr<std::unique_ptr<UncertaintySource>> OpenServer(const std::string& address,
                                                              const std::string& table,
                                                              const Patience& patience = {},
                                                              const Credentials& credentials = {});

// All tables of a server.
absl::StatusOr<std::vector<TableSummary>> ListServerTables(const std::string& address,
                                                           const Credentials& credentials = {});

}  // namespace albtpu::client
