#include <gmock/gmock.h>

#include "service/server/ground/listening_sockets.h"

namespace albtpu::server {
namespace {

ListenAddress Parsed(std::string_view text) {
  const absl::StatusOr<ListenAddress> address = ListenAddress::Parse(text);
  return *address;
}

TEST(ListenAddress, ConsistsOfHostAndPort) {
  for (const char* text : {"127.0.0.1:50051", "localhost:0", "[::1]:65535", "0.0.0.0:80", "sea.example.org:1"})
    EXPECT_EQ(Parsed(text).ToString(), text);
  EXPECT_EQ(Parsed("[::]:0").WithPort(17), "[::]:17");
}

TEST(ListenAddress, RejectsAnythingElse) {
  for (const char* text : {"", "50051", ":50051", "127.0.0.1", "127.0.0.1:", "127.0.0.1:http", "127.0.0.1:65536",
                           "127.0.0.1:-1", "127.0.0.1:+1", "127.0.0.1: 1", "::1:80", "[127.0.0.1]:80", "[]:80",
                           "unix:/tmp/x", "127.0.0.1:99999999999999999999"}) {
    const absl::Status status = ListenAddress::Parse(text).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << text;
    EXPECT_THAT(std::string(status.message()), ::testing::HasSubstr("HOST:PORT"));
  }
}

TEST(ListenAddress, KnowsWhetherOnlyThisMachineCanReachIt) {
  for (const char* text : {"127.0.0.1:0", "127.1.2.3:0", "[::1]:0", "localhost:0"})
    EXPECT_TRUE(Parsed(text).IsLoopback()) << text;
  for (const char* text : {"0.0.0.0:0", "[::]:0", "192.168.0.1:0", "128.0.0.1:0", "127.0.0.1.example.org:0"})
    EXPECT_FALSE(Parsed(text).IsLoopback()) << text;
}

}  // namespace
}  // namespace albtpu::server
