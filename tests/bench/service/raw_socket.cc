#include "tests/bench/service/raw_socket.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <thread>

namespace albtpu::bench {
namespace {

void Check(bool good, const char* what) {
  if (good) return;
  std::cerr << "service_bench: " << what << ": " << std::strerror(errno) << "\n";
  std::exit(1);
}

void SendAtOnce(int socket) {
  const int on = 1;
  Check(setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on) == 0, "TCP_NODELAY");
}

sockaddr_in Loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

}  // namespace

bool WriteAll(int socket, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t sent = send(socket, bytes, count, MSG_NOSIGNAL);
    if (sent <= 0) return false;
    bytes += sent;
    count -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool ReadAll(int socket, char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t received = recv(socket, bytes, count, 0);
    if (received <= 0) return false;
    bytes += received;
    count -= static_cast<std::size_t>(received);
  }
  return true;
}

void ServeConnections(const std::function<void(int socket)>& serve) {
  const int listener = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address = Loopback(0);
  socklen_t length = sizeof address;
  Check(bind(listener, reinterpret_cast<sockaddr*>(&address), length) == 0, "bind");
  Check(listen(listener, SOMAXCONN) == 0, "listen");
  Check(getsockname(listener, reinterpret_cast<sockaddr*>(&address), &length) == 0, "getsockname");
  std::cout << ntohs(address.sin_port) << std::endl;
  for (;;) {
    const int socket = accept(listener, nullptr, nullptr);
    Check(socket >= 0, "accept");
    SendAtOnce(socket);
    std::thread([socket, &serve] { serve(socket); }).detach();
  }
}

int ConnectTo(const std::string& port) {
  const int connection = socket(AF_INET, SOCK_STREAM, 0);
  const sockaddr_in address = Loopback(static_cast<std::uint16_t>(std::stoi(port)));
  Check(connect(connection, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0, "connect");
  SendAtOnce(connection);
  return connection;
}

}  // namespace albtpu::bench
