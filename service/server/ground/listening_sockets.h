// The sockets on which a server listens.
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

// Opens one non-blocking socket for each address of the host (`localhost` has 127.0.0.1 and ::1), all on the same
// port. Addresses of a family that this machine does not support are skipped. Unavailable, with the reason, if no
// address remains or another program listens on one of them.
absl::StatusOr<std::vector<ListeningSocket>> Listen(const ListenAddress& address);

}  // namespace albtpu::server
