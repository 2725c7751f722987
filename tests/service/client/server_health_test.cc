#include <gmock/gmock.h>

#include "service/client/channel.h"
#include "tests/service/client/running_server.h"

namespace albtpu::client {
namespace {

using ::testing::HasSubstr;

TEST(ServerHealth, IsOkWhileTheServerServes) {
  const RunningServer server;
  EXPECT_TRUE(CheckHealth(server.address()).ok());
}

TEST(ServerHealth, IsOkWhenOneOfSeveralServersServes) {
  RunningServer first;
  const RunningServer second;
  first.Stop();
  EXPECT_TRUE(CheckHealth(AllOf({first.address(), second.address()})).ok());
}

TEST(ServerHealth, ReportsTheProblem) {
  RunningServer server;
  const std::string address = server.address();
  server.Stop();
  const absl::Status gone = CheckHealth(address);
  EXPECT_EQ(gone.code(), absl::StatusCode::kUnavailable);
  EXPECT_THAT(std::string(gone.message()), HasSubstr(address));
  const absl::Status no_file = CheckHealth(address, {.ca = "nowhere.pem"});
  EXPECT_THAT(std::string(no_file.message()), HasSubstr("--tls-ca: nowhere.pem"));
}

}  // namespace
}  // namespace albtpu::client
