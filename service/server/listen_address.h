// HOST:PORT, as --listen takes it.
#pragma once

#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace albtpu::server {

class ListenAddress {
 public:
  // `127.0.0.1:50051`, `[::1]:0` or `localhost:50051`; port 0 means any free one. InvalidArgument for
  // anything else.
  static absl::StatusOr<ListenAddress> Parse(std::string_view text);

  // Whether only this machine can reach it: 127.0.0.0/8, ::1 or localhost.
  bool IsLoopback() const;

  std::string ToString() const { return WithPort(port_); }
  std::string WithPort(int port) const;

  // Tries to listen there for a moment, and says why it cannot.
  absl::Status Probe() const;

 private:
  ListenAddress(std::string_view host, int port) : host_(host), port_(port) {}

  std::string host_;  // Without brackets.
  int port_;
};

}  // namespace albtpu::server
