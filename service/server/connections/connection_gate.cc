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
#include <chrono>
#include <cstring>
#include <set>
#include <system_error>
#include <utility>

#include "service/server/ground/limits.h"

namespace albtpu::server {
namespace {

// Connections that are taken before others have their turn: another socket, or the end.
constexpr int kMostATurn = 64;

// How long those who wait to be let in wait when the system has no room.
constexpr int kPauseMilliseconds = 100;

// The system gives the lowest descriptor that is free: its number tells how many are open.
int EndOfDescriptors() {
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  // The usual 1024 is for programs that call select(), which cannot tell more apart; nothing here does.
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

// As gRPC sets those that it takes itself.
void Prepare(int connection) {
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
      end_of_descriptors_(EndOfDescriptors()),
      stop_(StopSignal()),
      thread_([this] { Run(); }) {}

ConnectionGate::~ConnectionGate() {
  eventfd_write(stop_, 1);
  thread_.join();
  close(stop_);
}

std::vector<Caller> ConnectionGate::End(const std::vector<Caller>& callers) {
  // gRPC closes descriptors when it likes: the system alone knows whose they are. While the lock is held none
  // becomes another connection of the gate.
  const std::lock_guard lock(taking_);
  const std::set<Caller> to_end(callers.begin(), callers.end());
  std::vector<Caller> ended;
  for (int descriptor = 0; descriptor < end_of_descriptors_; ++descriptor) {
    const Caller caller = CallerOf(descriptor);
    if (caller.address.empty() || to_end.count(caller) == 0) continue;
    // Not shutdown(): that leaves what has come to be read, up to some megabytes.
    const sockaddr none{.sa_family = AF_UNSPEC, .sa_data = {}};
    if (connect(descriptor, &none, sizeof none) != 0) shutdown(descriptor, SHUT_RDWR);
    ended.push_back(caller);
  }
  return ended;
}

void ConnectionGate::Run() {
  std::vector<pollfd> events{{stop_, POLLIN, 0}};
  for (const ListeningSocket& socket : sockets_) events.push_back({socket.descriptor(), POLLIN, 0});
  while (true) {
    if (poll(events.data(), events.size(), -1) < 0) continue;  // A signal.
    if (events[0].revents != 0) return;
    for (std::size_t i = 0; i < sockets_.size(); ++i) {
      if (events[i + 1].revents != 0) AcceptSome(sockets_[i]);
    }
  }
}

void ConnectionGate::AcceptSome(const ListeningSocket& socket) {
  for (int i = 0; i < kMostATurn; ++i) {
    std::unique_lock lock(taking_);
    const int connection = accept4(socket.descriptor(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    const int error = errno;
    lock.unlock();
    if (connection >= end_of_descriptors_) {
      Refuse(connection);
    } else if (connection >= 0) {
      Prepare(connection);
      Acceptor::NewConnectionParameters parameters;
      parameters.listener_fd = socket.descriptor();
      parameters.fd = connection;
      acceptor_->HandleNewConnection(&parameters);
    } else if (error == EAGAIN || error == EWOULDBLOCK) {
      return;
    } else if (error == EMFILE || error == ENFILE || error == ENOBUFS || error == ENOMEM) {
      spdlog::warn("connections wait: {}", std::strerror(error));
      pollfd stop{stop_, POLLIN, 0};
      poll(&stop, 1, kPauseMilliseconds);
      return;
    }  // Else it has gone already.
  }
}

void ConnectionGate::Refuse(int connection) {
  close(connection);
  metrics_.CountRefusedConnection();
  const auto now = std::chrono::steady_clock::now();
  ++refused_;
  if (now < next_line_) return;
  spdlog::warn("as many connections as can be: {} refused", std::exchange(refused_, 0));
  next_line_ = now + std::chrono::seconds(1);
}

}  // namespace albtpu::server
