// The addresses and sockets on which a server listens.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"

namespace albtpu::server {

// HOST:PORT, as --listen and --metrics take it.

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

class ListeningSocket {
 public:
  explicit ListeningSocket(int descriptor) : descriptor_(descriptor) {}
  ListeningSocket(ListeningSocket&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  ListeningSocket& operator=(ListeningSocket&&) = delete;
  ~ListeningSocket();

  int descriptor() const { return descriptor_; }
  int port() const;

 private:
  int descriptor_;
};

// Opens one non-blocking socket for each address of the host (`localhost` has 127.0.0.1 and ::1), all on the same
// port. Addresses of a family that this machine does not support are skipped. Unavailable, with the reason, if no
// address remains or another program listens on one of them.
absl::StatusOr<std::vector<ListeningSocket>> Listen(const ListenAddress& address);

}  // namespace albtpu::server
