#include "service/client/sea_sources.h"

#include <utility>

#include "sea/table/sea_table.h"
#include "service/client/channel.h"
#include "service/client/local_source.h"
#include "service/client/server_tables.h"
#include "service/client/wire.h"

namespace albtpu::client {
namespace {

class LocalSeaSources final : public SeaSources {
 public:
  absl::StatusOr<std::unique_ptr<UncertaintySource>> Open(const KnownSea& sea) override {
    const absl::StatusOr<UncertaintyTable> table = CompileSea(compiler_, sea);
    if (!table.ok()) return table.status();
    return std::make_unique<LocalSource>("", *table);
  }

 private:
  const SeaCompiler compiler_;
};

class ServerSeaSources final : public SeaSources {
 public:
  explicit ServerSeaSources(ServerConnection server) : server_(std::move(server)) {}

  absl::StatusOr<std::unique_ptr<UncertaintySource>> Open(const KnownSea& sea) override {
    auto state = std::make_unique<const albtpu::v1::SeaState>(ToWire(sea));
    absl::StatusOr<TableSummary> table = CompileSea(server_, *state);
    if (!table.ok()) return table.status();
    return MakeServerSource(server_, *std::move(table), std::move(state));
  }

 private:
  const ServerConnection server_;
};

}  // namespace

std::unique_ptr<SeaSources> LocalSeas() { return std::make_unique<LocalSeaSources>(); }

absl::StatusOr<std::unique_ptr<SeaSources>> ServerSeas(const std::string& address, const Patience& patience,
                                                       const Credentials& credentials) {
  absl::StatusOr<std::shared_ptr<grpc::Channel>> channel = OpenChannel(address, credentials);
  if (!channel.ok()) return channel.status();
  return std::make_unique<ServerSeaSources>(ServerConnection{address, *std::move(channel), patience});
}

}  // namespace albtpu::client
