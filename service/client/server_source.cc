#include "service/client/server_source.h"

#include <utility>

#include "service/client/channel.h"
#include "service/client/server_tables.h"

namespace albtpu::client {

absl::StatusOr<std::unique_ptr<UncertaintySource>> OpenServer(const std::string& address, const std::string& table,
                                                              const Patience& patience,
                                                              const Credentials& credentials) {
  const absl::StatusOr<std::shared_ptr<grpc::Channel>> channel = OpenChannel(address, credentials);
  if (!channel.ok()) return channel.status();
  const ServerConnection server{address, *channel, patience};
  absl::StatusOr<TableSummary> summary = GetTable(server, table);
  if (!summary.ok()) return summary.status();
  return MakeServerSource(server, *std::move(summary));
}

absl::StatusOr<std::vector<TableSummary>> ListServerTables(const std::string& address, const Credentials& credentials) {
  const absl::StatusOr<std::shared_ptr<grpc::Channel>> channel = OpenChannel(address, credentials);
  if (!channel.ok()) return channel.status();
  const ServerConnection server{address, *channel, {}};
  const absl::StatusOr<albtpu::v1::ListTablesResponse> response = ListTables(server);
  if (!response.ok()) return response.status();
  std::vector<TableSummary> tables;
  for (const auto& listed : response->tables()) {
    absl::StatusOr<TableSummary> table = GetTable(server, listed.reference().name());
    if (!table.ok()) return table.status();
    table->is_default = listed.reference().name() == response->default_table();
    tables.push_back(*std::move(table));
  }
  return tables;
}

}  // namespace albtpu::client
