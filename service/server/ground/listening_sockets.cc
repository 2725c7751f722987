#include "service/server/ground/listening_sockets.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "status/status_macros.h"

namespace albtpu::server {
namespace {

absl::Status InvalidAddress(std::string_view text) {
  return absl::InvalidArgumentError(
      absl::StrCat("'", std::string(text),
                   "' is not an address to listen on: expected HOST:PORT, such as 127.0.0.1:50051 or [::1]:0"));
}

}  // namespace

absl::StatusOr<ListenAddress> ListenAddress::Parse(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return InvalidAddress(text);
  std::string_view host = text.substr(0, colon);
  const std::string port_text(text.substr(colon + 1));
  const bool bracketed = host.size() >= 2 && host.front() == '[' && host.back() == ']';
  if (bracketed) host = host.substr(1, host.size() - 2);
  // An IPv6 address, and no other host, is written in brackets.
  const bool has_colon = host.find(':') != std::string_view::npos;
  int port = 0;
  if (host.empty() || has_colon != bracketed || port_text.find_first_not_of("0123456789") != std::string::npos ||
      !absl::SimpleAtoi(port_text, &port) || port > 65535)
    return InvalidAddress(text);
  return ListenAddress(host, port);
}

bool ListenAddress::IsLoopback() const {
  in_addr v4;
  if (inet_pton(AF_INET, host_.c_str(), &v4) == 1) return (ntohl(v4.s_addr) >> 24) == 127;
  in6_addr v6;
  if (inet_pton(AF_INET6, host_.c_str(), &v6) == 1) return IN6_IS_ADDR_LOOPBACK(&v6);
  return host_ == "localhost";
}

std::string ListenAddress::WithPort(int port) const {
  const bool is_v6 = host_.find(':') != std::string::npos;
  return is_v6 ? absl::StrCat("[", host_, "]:", port) : absl::StrCat(host_, ":", port);
}

namespace {

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

absl::StatusOr<Addresses> Resolve(const ListenAddress& address) {
  addrinfo hints{};
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(address.host().c_str(), std::to_string(address.port()).c_str(), &hints, &found);
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
  ASSIGN_OR_RETURN(Addresses addresses, Resolve(address));
  std::vector<ListeningSocket> sockets;
  absl::Status failure;
  for (addrinfo* candidate = addresses.get(); candidate != nullptr; candidate = candidate->ai_next) {
    if (!sockets.empty()) SetPort(candidate->ai_addr, sockets.front().port());
    ListeningSocket socket(::socket(candidate->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    if (ListenOn(socket.descriptor(), *candidate)) {
      sockets.push_back(std::move(socket));
      continue;
    }
    const int error = errno;
    const absl::Status reason = absl::UnavailableError(absl::StrCat(address.ToString(), ": ", std::strerror(error)));
    if (error == EADDRINUSE) return reason;
    failure.Update(reason);
  }
  if (sockets.empty()) return failure;
  return sockets;
}

}  // namespace albtpu::server
