// The sockets that a server listens with.
#pragma once

#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "service/server/ground/listen_address.h"

namespace albtpu::server {

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

// One socket, which does not block, for each address that the host has (`localhost`: 127.0.0.1 and ::1), all
// on one port. Addresses of a family that this machine does not have are left out. Unavailable, with the
// reason, when none is left or somebody else listens on one.
absl::StatusOr<std::vector<ListeningSocket>> Listen(const ListenAddress& address);

}  // namespace albtpu::server
