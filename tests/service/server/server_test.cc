#include "service/server/server.h"

#include <gmock/gmock.h>

#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

using ::testing::HasSubstr;

using RunningServer = ServedTables;

TEST_F(RunningServer, ReportsWhyItCannotListen) {
  const absl::Status status = Start(server_->address()).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kUnavailable);
  EXPECT_THAT(std::string(status.message()), HasSubstr("Address already in use"));
  // 192.0.2.0/24 is reserved for documentation: no machine has it (RFC 5737).
  const absl::Status foreign = Start("192.0.2.1:0").status();
  EXPECT_THAT(std::string(foreign.message()), HasSubstr("192.0.2.1:0"));
}

TEST_F(RunningServer, ReleasesItsPortWhenDrained) {
  server_->Drain();
  EXPECT_TRUE(Start(server_->address()).ok());
}

TEST_F(RunningServer, DrainsAtOnceIfNoCallIsInProgress) {
  v1::ListTablesResponse response;
  ASSERT_TRUE(ListTables(response).ok());
  const auto begin = std::chrono::steady_clock::now();
  server_->Drain();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, kDrainTime / 2);
}

}  // namespace
}  // namespace albtpu::server
