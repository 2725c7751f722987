// How many calls each connection has in memory.
#pragma once

#include <compare>
#include <string>
#include <vector>

namespace albtpu::server {

// Where a connection comes from.
struct Caller {
  std::string address;  // 4 or 16 bytes of IPv4 or IPv6; of IPv4 written as IPv6, the 4.
  int port = 0;

  auto operator<=>(const Caller&) const = default;
};

// As gRPC writes it: ipv4:127.0.0.1:4242, ipv6:%5B::1%5D:4242.
std::string ToText(const Caller& caller);

// The caller at the other end of a socket. Without an address if it has none, or is no connection.
Caller CallerOf(int descriptor);

struct ConnectionCalls {
  Caller caller;
  long calls = 0;
};

// Of all connections to servers in this process, what gRPC counts for its channelz: calls from the first byte
// of their header until nothing of them is left, be they taken back, answered or never sent whole. They cost
// memory for as long. Takes some 20 us for each connection.
std::vector<ConnectionCalls> CountConnectionCalls();

}  // namespace albtpu::server
