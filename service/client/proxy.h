// The HTTP proxy between a client and its server, by the environment.
#pragma once

#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace albtpu::client {

struct Proxy {
  std::string url;       // Without user and password: "http://proxy.example:3128".
  std::string variable;  // Of the environment: "https_proxy".
};

// Reads a variable of the environment; null if it is not set.
using Environment = std::function<const char*(const char*)>;

// The proxy through which `address`, in any form that OpenChannel takes, is reached; absent: none. As in gRPC, the
// first of grpc_proxy, https_proxy and http_proxy that is set counts, if it is an http:// URL. There is none for
// loopback addresses (127.0.0.0/8, ::1, localhost) and sockets of this machine (unix:), which no proxy can reach, and
// for the hosts that no_grpc_proxy, or else no_proxy, lists: ends of names, addresses, networks such as 10.0.0.0/8, or
// `*` for all.
std::optional<Proxy> ProxyFor(std::string_view address, const Environment& environment = std::getenv);

// " (through the proxy http://proxy.example:3128, from https_proxy)"; empty without one.
std::string ProxyText(std::string_view address);

}  // namespace albtpu::client
