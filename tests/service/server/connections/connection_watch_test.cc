#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <memory>
#include <thread>

#include "service/server/connections/connection_gate.h"
#include "service/server/ground/limits.h"
#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

ConnectionCalls Connection(int port, long calls) { return {{"\x7f\x01\x01\x01", port}, calls}; }

std::vector<int> PortsToDisconnect(std::vector<ConnectionCalls> connections) {
  std::vector<int> ports;
  for (const Caller& caller : CallersToDisconnect(std::move(connections))) ports.push_back(caller.port);
  return ports;
}

TEST(CallersToDisconnect, AreNoneIfAllAreWithinTheLimits) {
  EXPECT_EQ(PortsToDisconnect({}), std::vector<int>());
  EXPECT_EQ(PortsToDisconnect({Connection(1, 0), Connection(2, kMaxCallsInMemory)}), std::vector<int>());
}

TEST(CallersToDisconnect, AreThoseAboveTheLimitOfAConnection) {
  EXPECT_EQ(PortsToDisconnect({Connection(1, 1), Connection(2, kMaxCallsInMemory + 1), Connection(3, 100'000)}),
            std::vector<int>({3, 2}));
}

TEST(CallersToDisconnect, AreThoseWithTheMostCallsIfTheTotalIsTooHigh) {
  std::vector<ConnectionCalls> connections;
  for (int i = 0; i < 512; ++i) connections.push_back(Connection(i, kMaxCallsPerConnection));
  EXPECT_EQ(PortsToDisconnect(connections), std::vector<int>());
  connections.push_back(Connection(512, kMaxCallsPerConnection + 1));
  EXPECT_EQ(PortsToDisconnect(connections), std::vector<int>({512}));
}

using ConnectionWatchTest = ServedTables;

// tests/faults/floods_test.py covers connections that are closed.
TEST_F(ConnectionWatchTest, ClosesNothingIfMemoryGrowsForAnotherReason) {
  std::atomic<bool> disconnected = false;
  const ConnectionWatch watch([&](const std::vector<Caller>&) { disconnected = true; });
  v1::ListTablesResponse tables;
  ASSERT_TRUE(ListTables(tables).ok());
  std::vector<std::unique_ptr<char[]>> held;
  for (int i = 0; i < 4; ++i) {
    held.emplace_back(new char[kMemoryGrowth]);
    std::memset(held.back().get(), i + 1, kMemoryGrowth);
    ASSERT_TRUE(ListTables(tables).ok());
  }
  std::this_thread::sleep_for(50 * kMemoryCheckInterval);  // Long enough for the watch to see the growth.
  EXPECT_FALSE(disconnected);
}

}  // namespace
}  // namespace albtpu::server
