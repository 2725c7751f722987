#include "service/server/ground/listen_address.h"

#include <arpa/inet.h>
#include <sys/socket.h>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"

namespace albtpu::server {
namespace {

absl::Status InvalidAddress(std::string_view text) {
  return absl::InvalidArgumentError(absl::StrCat(
      "'", std::string(text),
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
  if (host.empty() || has_colon != bracketed ||
      port_text.find_first_not_of("0123456789") != std::string::npos || !absl::SimpleAtoi(port_text, &port) ||
      port > 65535) {
    return InvalidAddress(text);
  }
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

}  // namespace albtpu::server
