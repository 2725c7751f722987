#include "service/server/connections/connection_calls.h"

#include <arpa/inet.h>
#include <grpc/grpc.h>
#include <grpc/support/alloc.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>

#include "absl/strings/escaping.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"

namespace albtpu::server {
namespace {

using nlohmann::json;

// Parses JSON from gRPC and frees its text. Null if gRPC returned nothing.
json TakeJson(char* text) {
  const std::unique_ptr<char, void (*)(void*)> owned(text, gpr_free);
  return text == nullptr ? json() : json::parse(text, nullptr, false);
}

// In channelz, 64-bit numbers are text, and are left out if they are 0.
std::int64_t Number(const json& object, const char* name) {
  std::int64_t number = 0;
  if (const auto found = object.find(name); found != object.end() && found->is_string()) {
    if (!absl::SimpleAtoi(found->get_ref<const std::string&>(), &number)) return 0;
  }
  return number;
}

// Calls `visit` with the number `id` of each object `ref` in the lists `list` of the pages `page(first)`.
template <typename Page, typename Visit>
void ForEach(Page page, const char* list, const char* ref, const char* id, Visit visit) {
  std::int64_t first = 0;
  while (true) {
    const json found = TakeJson(page(first));
    if (!found.is_object()) return;
    for (const json& each : found.value(list, json::array())) {
      const std::int64_t number = Number(*ref == '\0' ? each : each.value(ref, json::object()), id);
      first = number + 1;
      visit(number);
    }
    if (found.value("end", false) || !found.contains(list)) return;
  }
}

ConnectionCalls ReadConnection(const json& socket) {
  const json data = socket.value("data", json::object());
  const json remote = socket.value("remote", json::object()).value("tcpip_address", json::object());
  ConnectionCalls connection;
  const std::string address = remote.value("ip_address", "");
  if (std::string bytes; absl::Base64Unescape(address, &bytes)) connection.caller.address = bytes;
  connection.caller.port = remote.value("port", 0);
  connection.calls =
      Number(data, "streamsStarted") - Number(data, "streamsSucceeded") - Number(data, "streamsFailed");
  return connection;
}

}  // namespace

Caller CallerOf(int descriptor) {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  if (getpeername(descriptor, reinterpret_cast<sockaddr*>(&address), &length) != 0) return {};
  if (address.ss_family == AF_INET) {
    const auto& ipv4 = reinterpret_cast<const sockaddr_in&>(address);
    return {std::string(reinterpret_cast<const char*>(&ipv4.sin_addr), 4), ntohs(ipv4.sin_port)};
  }
  if (address.ss_family != AF_INET6) return {};
  const auto& ipv6 = reinterpret_cast<const sockaddr_in6&>(address);
  const std::string bytes(reinterpret_cast<const char*>(&ipv6.sin6_addr), 16);
  return {IN6_IS_ADDR_V4MAPPED(&ipv6.sin6_addr) ? bytes.substr(12) : bytes, ntohs(ipv6.sin6_port)};
}

std::string ToText(const Caller& caller) {
  const bool ipv4 = caller.address.size() == sizeof(in_addr);
  char text[INET6_ADDRSTRLEN] = "";
  inet_ntop(ipv4 ? AF_INET : AF_INET6, caller.address.data(), text, sizeof text);
  return ipv4 ? absl::StrCat("ipv4:", text, ":", caller.port)
              : absl::StrCat("ipv6:%5B", text, "%5D:", caller.port);
}

std::vector<ConnectionCalls> CountConnectionCalls() {
  std::vector<ConnectionCalls> connections;
  ForEach(grpc_channelz_get_servers, "server", "ref", "serverId", [&](std::int64_t server) {
    const auto sockets = [server](std::int64_t first) {
      return grpc_channelz_get_server_sockets(server, first, 0);
    };
    ForEach(sockets, "socketRef", "", "socketId", [&](std::int64_t socket) {
      const json found = TakeJson(grpc_channelz_get_socket(socket));
      if (found.is_object()) connections.push_back(ReadConnection(found.value("socket", json::object())));
    });
  });
  return connections;
}

}  // namespace albtpu::server
