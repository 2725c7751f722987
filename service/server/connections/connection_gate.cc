#include "service/server/connections/connection_gate.h"

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
#include <cstring>
#include <set>
#include <system_error>
#include <utility>

#include "service/server/ground/limits.h"

namespace albtpu::server {
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
    for (std::size_t i = 0; i < sockets_.size(); ++i) {
      if (events[i + 1].revents != 0) AcceptSome(sockets_[i]);
    }
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
