// Servers for tests of the client, in the same process.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "service/server/observe/metrics.h"
#include "service/server/server.h"
#include "tables/file/table_io.h"
#include "tests/tables/synthetic_table.h"
#include "tests/temporary_folder.h"

namespace albtpu::client {

// A server with a single table, `quick`.
class RunningServer {
 public:
  explicit RunningServer(const albtpu::testing::SyntheticOptions& options = {},
                         const std::string& listen = "127.0.0.1:0",
                         const std::optional<std::filesystem::path>& water = std::nullopt) {
    const absl::Status written =
        WriteTable(albtpu::testing::SyntheticTable(options), folder_ / "quick.h5", Existing::kReplace);
    EXPECT_TRUE(written.ok()) << written;
    server::TableCatalog catalog = server::TableCatalog::Load(folder_ / "", "").value();
    if (water.has_value()) {
      EXPECT_TRUE(catalog.AddWater(*water).ok());
    }
    tables_.emplace(std::move(catalog));
    server_ = server::Server::Start(*tables_, {metrics_.calls, metrics_.access, metrics_.seas, metrics_.waters, log_},
                                    server::ListenAddress::Parse(listen).value())
                  .value();
  }
  const std::string& address() const { return server_->address(); }

  // The number of answers it has given to queries in columns.
  int answers() const {
    int count = 0;
    for (const prometheus::MetricFamily& family : metrics_.registry->Collect()) {
      if (family.name != "albtpu_answer_pulses") continue;
      for (const prometheus::ClientMetric& metric : family.metric)
        count += static_cast<int>(metric.histogram.sample_count);
    }
    return count;
  }

  void Stop() { server_->Drain(); }

 private:
  albtpu::testing::TemporaryFolder folder_;
  server::ServerMetrics metrics_;
  server::CallLog log_;
  std::optional<server::LiveTables> tables_;
  std::unique_ptr<server::Server> server_;
};

// A single address for several servers without a name.
inline std::string AllOf(const std::vector<std::string>& addresses) {
  return absl::StrCat("ipv4:", absl::StrJoin(addresses, ","));
}

}  // namespace albtpu::client
