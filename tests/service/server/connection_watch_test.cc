#include "service/server/connections/connection_watch.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <memory>
#include <thread>

#include "service/server/ground/limits.h"
#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

ConnectionCalls Connection(int port, long calls) { return {{"\x7f\x01\x01\x01", port}, calls}; }

std::vector<int> PortsToEnd(std::vector<ConnectionCalls> connections) {
  std::vector<int> ports;
  for (const Caller& caller : CallersToEnd(std::move(connections))) ports.push_back(caller.port);
  return ports;
}

TEST(CallersToEnd, AreNoneWhereEachHasWhatItMay) {
  EXPECT_EQ(PortsToEnd({}), std::vector<int>());
  EXPECT_EQ(PortsToEnd({Connection(1, 0), Connection(2, kMaxCallsInMemory)}), std::vector<int>());
}

TEST(CallersToEnd, AreThoseWithMoreThanAConnectionMayHave) {
  EXPECT_EQ(PortsToEnd({Connection(1, 1), Connection(2, kMaxCallsInMemory + 1), Connection(3, 100'000)}),
            std::vector<int>({3, 2}));
}

TEST(CallersToEnd, AreThoseWithMostWhereAllTogetherHaveTooMany) {
  std::vector<ConnectionCalls> connections;
  for (int i = 0; i < 512; ++i) connections.push_back(Connection(i, kMaxCallsPerConnection));
  EXPECT_EQ(PortsToEnd(connections), std::vector<int>());
  connections.push_back(Connection(512, kMaxCallsPerConnection + 1));
  EXPECT_EQ(PortsToEnd(connections), std::vector<int>({512}));
}

using ConnectionWatchTest = ServedTables;

// tests/faults/floods_test.py has those who are ended.
TEST_F(ConnectionWatchTest, EndsNobodyWhereMemoryGrowsForAnotherReason) {
  std::atomic<bool> ended = false;
  const ConnectionWatch watch([&](const std::vector<Caller>&) { ended = true; });
  v1::ListTablesResponse tables;
  ASSERT_TRUE(ListTables(tables).ok());
  std::vector<std::unique_ptr<char[]>> held;
  for (int i = 0; i < 4; ++i) {
    held.emplace_back(new char[kMemoryGrowth]);
    std::memset(held.back().get(), i + 1, kMemoryGrowth);
    ASSERT_TRUE(ListTables(tables).ok());
  }
  std::this_thread::sleep_for(50 * kMemoryLook);  // What is held is surely seen.
  EXPECT_FALSE(ended);
}

}  // namespace
}  // namespace albtpu::server
