// HOST:PORT, as --listen and --metrics take it.
#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace albtpu::server {

class ListenAddress {
 public:
  // `127.0.0.1:50051`, `[::1]:0` or `localhost:50051`; port 0 means any free port. InvalidArgument
  // for anything else.
  static absl::StatusOr<ListenAddress> Parse(std::string_view text);

  // Whether only this machine can reach the address: 127.0.0.0/8, ::1 or localhost.
  bool IsLoopback() const;

  const std::string& host() const { return host_; }
  int port() const { return port_; }

  std::string ToString() const { return WithPort(port_); }
  std::string WithPort(int port) const;

 private:
  ListenAddress(std::string_view host, int port) : host_(host), port_(port) {}

  std::string host_;  // Without brackets.
  int port_;
};

}  // namespace albtpu::server
