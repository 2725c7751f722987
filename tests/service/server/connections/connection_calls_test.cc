#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "service/server/connections/connection_gate.h"
#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

using ConnectionCallsTest = ServedTables;

long AllCalls() {
  long all = 0;
  for (const ConnectionCalls& connection : CountConnectionCalls()) all += connection.calls;
  return all;
}

// A call stays in memory for a moment after its caller has the answer.
bool WaitForCalls(long count) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (std::chrono::steady_clock::now() < end) {
    if (AllCalls() == count) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

TEST_F(ConnectionCallsTest, CountsACallUntilItHasEnded) {
  v1::ListTablesResponse tables;
  ASSERT_TRUE(ListTables(tables).ok());  // Opens a connection.
  ASSERT_TRUE(WaitForCalls(0));
  grpc::ClientContext context;
  auto stream = stub_->StreamColumns(&context);
  v1::StreamColumnsRequest request;
  *request.mutable_query()->mutable_pulses() = WireColumns(1);
  v1::StreamColumnsResponse answer;
  ASSERT_TRUE(stream->Write(request));
  ASSERT_TRUE(stream->Read(&answer));  // The call has begun.
  EXPECT_EQ(AllCalls(), 1);
  stream->WritesDone();
  ASSERT_TRUE(stream->Finish().ok());
  EXPECT_TRUE(WaitForCalls(0));
}

TEST_F(ConnectionCallsTest, IdentifiesTheCallerByItsAddress) {
  v1::ListTablesResponse tables;
  ASSERT_TRUE(ListTables(tables).ok());
  const std::vector<ConnectionCalls> connections = CountConnectionCalls();
  ASSERT_EQ(connections.size(), 1u);
  const std::string text = ToText(connections[0].caller);
  EXPECT_EQ(text.substr(0, 15), "ipv4:127.0.0.1:") << text;
  int descriptors = 0;  // Of the server's end; the peer of the client's end is the server.
  for (int descriptor = 0; descriptor < 1024; ++descriptor)
    descriptors += CallerOf(descriptor) == connections[0].caller ? 1 : 0;
  EXPECT_EQ(descriptors, 1);
}

TEST(Caller, IsEmptyWithoutAConnection) {
  EXPECT_EQ(CallerOf(-1), Caller());
  EXPECT_EQ(CallerOf(STDERR_FILENO), Caller());
}

TEST(Caller, IsWrittenAsInGrpc) {
  EXPECT_EQ(ToText({std::string("\x7f\0\0\x01", 4), 4242}), "ipv4:127.0.0.1:4242");
  EXPECT_EQ(ToText({std::string(15, '\0') + '\x01', 4242}), "ipv6:%5B::1%5D:4242");
}

}  // namespace
}  // namespace albtpu::server
