#include "service/server/connections/connection_gate.h"

#include <arpa/inet.h>
#include <grpc/grpc.h>
#include <grpc/support/alloc.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <utility>

#include "absl/strings/escaping.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "service/server/ground/limits.h"

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
  connection.calls = Number(data, "streamsStarted") - Number(data, "streamsSucceeded") - Number(data, "streamsFailed");
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
  return ipv4 ? absl::StrCat("ipv4:", text, ":", caller.port) : absl::StrCat("ipv6:%5B", text, "%5D:", caller.port);
}

std::vector<ConnectionCalls> CountConnectionCalls() {
  std::vector<ConnectionCalls> connections;
  ForEach(grpc_channelz_get_servers, "server", "ref", "serverId", [&](std::int64_t server) {
    const auto sockets = [server](std::int64_t first) { return grpc_channelz_get_server_sockets(server, first, 0); };
    ForEach(sockets, "socketRef", "", "socketId", [&](std::int64_t socket) {
      const json found = TakeJson(grpc_channelz_get_socket(socket));
      if (found.is_object()) connections.push_back(ReadConnection(found.value("socket", json::object())));
    });
  });
  return connections;
}

namespace {

double ResidentBytes() {
  const std::optional<ProcessMemory> memory = ReadProcessMemory();
  return memory.has_value() ? memory->resident_bytes : 0;
}

}  // namespace

std::vector<Caller> CallersToDisconnect(std::vector<ConnectionCalls> connections) {
  std::sort(connections.begin(), connections.end(),
            [](const ConnectionCalls& a, const ConnectionCalls& b) { return a.calls > b.calls; });
  long total = 0;
  for (const ConnectionCalls& connection : connections) total += connection.calls;
  std::vector<Caller> callers;
  for (const ConnectionCalls& connection : connections) {
    if (connection.calls <= kMaxCallsInMemory && total <= kMaxTotalCallsInMemory) break;
    callers.push_back(connection.caller);
    total -= connection.calls;
  }
  return callers;
}

ConnectionWatch::ConnectionWatch(std::function<void(const std::vector<Caller>&)> disconnect)
    : disconnect_(std::move(disconnect)),
      resident_bytes_(ResidentBytes()),
      checking_(kMemoryCheckInterval, [this] { Check(); }) {}

void ConnectionWatch::Check() {
  const double bytes = ResidentBytes();
  if (bytes > resident_bytes_ + static_cast<double>(kMemoryGrowth)) {
    const std::vector<Caller> callers = CallersToDisconnect(CountConnectionCalls());
    if (!callers.empty()) disconnect_(callers);
    resident_bytes_ = bytes;
  }
  resident_bytes_ = std::min(resident_bytes_, bytes);
}

namespace {

// Connections that are accepted before another socket, or a stop, has its turn.
constexpr int kMaxAcceptsPerTurn = 64;

// Pause before the next attempt when the system has no resources for another connection.
constexpr int kPauseMilliseconds = 100;

// The first descriptor that is too high. The system assigns the lowest free descriptor, so its number shows how many
// are open.
int DescriptorLimit() {
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  // The usual limit of 1024 protects programs that call select(), which supports no more; nothing here does.
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_NOFILE, &limit);
  getrlimit(RLIMIT_NOFILE, &limit);
  const rlim_t most = kMaxConnections + kOwnDescriptors;
  return static_cast<int>(std::min(most, limit.rlim_cur)) - kOwnDescriptors / 2;
}

int StopSignal() {
  const int descriptor = eventfd(0, EFD_CLOEXEC);
  if (descriptor < 0) throw std::system_error(errno, std::generic_category(), "cannot make an eventfd");
  return descriptor;
}

// Sets the options that gRPC sets on connections that it accepts itself.
void SetSocketOptions(int connection) {
  const int on = 1;
  setsockopt(connection, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  const auto timeout = static_cast<unsigned>(std::chrono::milliseconds(kKeepaliveTimeout).count());
  setsockopt(connection, IPPROTO_TCP, TCP_USER_TIMEOUT, &timeout, sizeof timeout);
}

}  // namespace

ConnectionGate::ConnectionGate(std::vector<ListeningSocket> sockets, std::unique_ptr<Acceptor> acceptor,
                               AccessMetrics& metrics)
    : sockets_(std::move(sockets)),
      acceptor_(std::move(acceptor)),
      metrics_(metrics),
      descriptor_limit_(DescriptorLimit()),
      stop_(StopSignal()),
      thread_([this] { Run(); }) {}

ConnectionGate::~ConnectionGate() {
  eventfd_write(stop_, 1);
  thread_.join();
  close(stop_);
}

std::vector<Caller> ConnectionGate::Disconnect(const std::vector<Caller>& callers) {
  // gRPC may close descriptors at any time, so only the system knows to whom they belong. While the lock is held, none
  // of them can be reused for a new connection.
  const std::lock_guard lock(accept_mutex_);
  const std::set<Caller> to_disconnect(callers.begin(), callers.end());
  std::vector<Caller> disconnected;
  for (int descriptor = 0; descriptor < descriptor_limit_; ++descriptor) {
    const Caller caller = CallerOf(descriptor);
    if (caller.address.empty() || to_disconnect.count(caller) == 0) continue;
    // shutdown() is only the fallback: it would leave data that has arrived, up to some megabytes, to be read.
    const sockaddr none{.sa_family = AF_UNSPEC, .sa_data = {}};
    if (connect(descriptor, &none, sizeof none) != 0) shutdown(descriptor, SHUT_RDWR);
    disconnected.push_back(caller);
  }
  return disconnected;
}

void ConnectionGate::Run() {
  std::vector<pollfd> events{{stop_, POLLIN, 0}};
  for (const ListeningSocket& socket : sockets_) events.push_back({socket.descriptor(), POLLIN, 0});
  while (true) {
    if (poll(events.data(), events.size(), -1) < 0) continue;  // Interrupted by a signal.
    if (events[0].revents != 0) return;
    for (std::size_t i = 0; i < sockets_.size(); ++i)
      if (events[i + 1].revents != 0) AcceptSome(sockets_[i]);
  }
}

void ConnectionGate::AcceptSome(const ListeningSocket& socket) {
  for (int i = 0; i < kMaxAcceptsPerTurn; ++i) {
    std::unique_lock lock(accept_mutex_);
    const int connection = accept4(socket.descriptor(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    const int error = errno;
    lock.unlock();
    if (connection >= descriptor_limit_) {
      Refuse(connection);
    } else if (connection >= 0) {
      SetSocketOptions(connection);
      Acceptor::NewConnectionParameters parameters;
      parameters.listener_fd = socket.descriptor();
      parameters.fd = connection;
      acceptor_->HandleNewConnection(&parameters);
    } else if (error == EAGAIN || error == EWOULDBLOCK) {
      return;
    } else if (error == EMFILE || error == ENFILE || error == ENOBUFS || error == ENOMEM) {
      spdlog::warn("cannot accept connections, which wait: {}", std::strerror(error));
      pollfd stop{stop_, POLLIN, 0};
      poll(&stop, 1, kPauseMilliseconds);
      return;
    }  // Otherwise the client has already disconnected.
  }
}

void ConnectionGate::Refuse(int connection) {
  close(connection);
  metrics_.CountRefusedConnection();
  const auto now = std::chrono::steady_clock::now();
  ++refused_;
  if (now < next_line_) return;
  spdlog::warn("too many connections: {} refused", std::exchange(refused_, 0));
  next_line_ = now + std::chrono::seconds(1);
}

}  // namespace albtpu::server
