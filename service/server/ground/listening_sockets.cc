#include "service/server/ground/listening_sockets.h"

#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"

namespace albtpu::server {
namespace {

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

absl::StatusOr<Addresses> Resolve(const ListenAddress& address) {
  addrinfo hints{};
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int error =
      getaddrinfo(address.host().c_str(), std::to_string(address.port()).c_str(), &hints, &found);
  if (error == 0) return Addresses(found, freeaddrinfo);
  return absl::UnavailableError(absl::StrCat(address.ToString(), ": ", gai_strerror(error)));
}

void SetPort(sockaddr* address, int port) {
  const in_port_t network_order = htons(static_cast<in_port_t>(port));
  if (address->sa_family == AF_INET) reinterpret_cast<sockaddr_in*>(address)->sin_port = network_order;
  if (address->sa_family == AF_INET6) reinterpret_cast<sockaddr_in6*>(address)->sin6_port = network_order;
}

// Returns whether the socket listens; if not, errno says why.
bool ListenOn(int descriptor, const addrinfo& address) {
  const int on = 1;  // Allows a port whose last user has just exited.
  return descriptor >= 0 && setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0 &&
         bind(descriptor, address.ai_addr, address.ai_addrlen) == 0 && listen(descriptor, SOMAXCONN) == 0;
}

}  // namespace

ListeningSocket::~ListeningSocket() {
  if (descriptor_ >= 0) close(descriptor_);
}

int ListeningSocket::port() const {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &length);
  return ntohs(address.ss_family == AF_INET6 ? reinterpret_cast<sockaddr_in6*>(&address)->sin6_port
                                             : reinterpret_cast<sockaddr_in*>(&address)->sin_port);
}

absl::StatusOr<std::vector<ListeningSocket>> Listen(const ListenAddress& address) {
  absl::StatusOr<Addresses> addresses = Resolve(address);
  if (!addresses.ok()) return addresses.status();
  std::vector<ListeningSocket> sockets;
  absl::Status failure;
  for (addrinfo* candidate = addresses->get(); candidate != nullptr; candidate = candidate->ai_next) {
    if (!sockets.empty()) SetPort(candidate->ai_addr, sockets.front().port());
    ListeningSocket socket(::socket(candidate->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    if (ListenOn(socket.descriptor(), *candidate)) {
      sockets.push_back(std::move(socket));
      continue;
    }
    const int error = errno;
    const absl::Status reason =
        absl::UnavailableError(absl::StrCat(address.ToString(), ": ", std::strerror(error)));
    if (error == EADDRINUSE) return reason;
    failure.Update(reason);
  }
  if (sockets.empty()) return failure;
  return sockets;
}

}  // namespace albtpu::server
