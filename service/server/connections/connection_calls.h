// Counts the calls that each connection has in memory.
#pragma once

#include <compare>
#include <string>
#include <vector>

namespace albtpu::server {

// The remote end of a connection.
struct Caller {
  std::string address;  // 4 bytes for IPv4, also if mapped to IPv6; otherwise 16.
  int port = 0;

  auto operator<=>(const Caller&) const = default;
};

// As gRPC writes it: ipv4:127.0.0.1:4242, ipv6:%5B::1%5D:4242.
std::string ToText(const Caller& caller);

// The caller at the other end of a socket. Its address is empty if the descriptor is not a connection.
Caller CallerOf(int descriptor);

struct ConnectionCalls {
  Caller caller;
  long calls = 0;
};

// Calls of all connections to servers in this process, as gRPC counts them for channelz: from the first byte of their
// header until they are freed, whether cancelled, answered or never sent completely. They take memory for that time.
// Takes about 20 us for each connection.
std::vector<ConnectionCalls> CountConnectionCalls();

}  // namespace albtpu::server
