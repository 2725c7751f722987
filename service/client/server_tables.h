// The tables of a server, its own and those of seas, and sources that query them.
#pragma once

#include <grpcpp/channel.h>

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/client/patience.h"
#include "service/client/uncertainty_source.h"

namespace albtpu::client {

struct ServerConnection {
  std::string address;  // For messages.
  std::shared_ptr<grpc::Channel> channel;
  Patience patience;
};

// Calls that precede the first pulse, with a few retries: if one of several servers has just stopped, another one
// answers. Errors name the address.
absl::StatusOr<albtpu::v1::ListTablesResponse> ListTables(const ServerConnection& server);
absl::StatusOr<TableSummary> GetTable(const ServerConnection& server, const std::string& table);
absl::StatusOr<TableSummary> CompileSea(const ServerConnection& server, const albtpu::v1::SeaState& sea);

// A source that queries the table, which is that of `sea`, or one of the server's if `sea` is null.
std::unique_ptr<UncertaintySource> MakeServerSource(const ServerConnection& server, TableSummary table,
                                                    std::unique_ptr<const albtpu::v1::SeaState> sea = nullptr);

}  // namespace albtpu::client
