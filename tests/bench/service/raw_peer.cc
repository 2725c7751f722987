#include "tests/bench/service/raw_peer.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <thread>

namespace albtpu::bench {
namespace {

struct Header {
  std::uint32_t count;
  float wind_speed;
};

std::size_t RequestBytes(const Question& question, std::size_t count) {
  return sizeof(Header) + question.columns * count * sizeof(float);
}
std::size_t AnswerBytes(const Question& question, std::size_t count) {
  return count * (question.quantities * sizeof(float) + 2);
}

void CheckCall(bool good, const char* what) { Check(good, std::string(what) + ": " + std::strerror(errno)); }

void SendAtOnce(int socket) {
  const int on = 1;
  CheckCall(setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on) == 0, "TCP_NODELAY");
}

sockaddr_in Loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

// False when the other side has closed the connection.
bool WriteAll(int socket, std::span<iovec> parts) {
  while (!parts.empty()) {
    msghdr message{};
    message.msg_iov = parts.data();
    message.msg_iovlen = parts.size();
    const ssize_t result = sendmsg(socket, &message, MSG_NOSIGNAL);
    if (result <= 0) return false;
    auto sent = static_cast<std::size_t>(result);
    for (; !parts.empty() && sent >= parts[0].iov_len; parts = parts.subspan(1)) sent -= parts[0].iov_len;
    if (parts.empty()) return true;
    parts[0].iov_base = static_cast<char*>(parts[0].iov_base) + sent;
    parts[0].iov_len -= sent;
  }
  return true;
}

void Serve(int socket, const Question& question, const AnswerRaw& answer) {
  std::vector<char> requests(2 * RequestBytes(question, kMostRawPulses)), bytes(AnswerBytes(question, kMostRawPulses));
  std::size_t have = 0;
  for (;;) {
    const ssize_t received = recv(socket, requests.data() + have, requests.size() - have, 0);
    if (received <= 0) break;
    have += static_cast<std::size_t>(received);
    std::size_t taken = 0;
    while (have - taken >= sizeof(Header)) {
      const char* const request = requests.data() + taken;
      const auto* const header = reinterpret_cast<const Header*>(request);
      const std::size_t count = header->count;
      if (have - taken < RequestBytes(question, count)) break;
      const auto* const numbers = reinterpret_cast<const float*>(header + 1);
      Columns columns;
      for (std::size_t c = 0; c < question.columns; ++c) columns[c] = {numbers + c * count, count};
      auto* const values = reinterpret_cast<float*>(bytes.data());
      answer(header->wind_speed, columns, values,
             reinterpret_cast<std::uint8_t*>(values + question.quantities * count));
      iovec part{bytes.data(), AnswerBytes(question, count)};
      if (!WriteAll(socket, {&part, 1})) break;
      taken += RequestBytes(question, count);
    }
    have -= taken;
    std::memmove(requests.data(), requests.data() + taken, have);
  }
  close(socket);
}

}  // namespace

void Check(bool good, const std::string& what) {
  if (good) return;
  std::cerr << "service_bench: " << what << "\n";
  std::exit(1);
}

void ServeRaw(const Question& question, const AnswerRaw& answer) {
  const int listener = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address = Loopback(0);
  socklen_t length = sizeof address;
  CheckCall(bind(listener, reinterpret_cast<sockaddr*>(&address), length) == 0, "bind");
  CheckCall(listen(listener, SOMAXCONN) == 0, "listen");
  CheckCall(getsockname(listener, reinterpret_cast<sockaddr*>(&address), &length) == 0, "getsockname");
  std::cout << ntohs(address.sin_port) << std::endl;
  for (;;) {
    const int socket = accept(listener, nullptr, nullptr);
    CheckCall(socket >= 0, "accept");
    SendAtOnce(socket);
    std::thread([socket, &question, &answer] { Serve(socket, question, answer); }).detach();
  }
}

RawConnection::RawConnection(const std::string& port, const Question& question)
    : socket_(socket(AF_INET, SOCK_STREAM, 0)),
      question_(question),
      incoming_(2 * AnswerBytes(question, kMostRawPulses)) {
  const sockaddr_in address = Loopback(static_cast<std::uint16_t>(std::stoi(port)));
  CheckCall(connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0, "connect");
  SendAtOnce(socket_);
}

RawConnection::~RawConnection() { close(socket_); }

void RawConnection::Send(const FlightLine& line, std::size_t begin, std::size_t count) {
  Header header{static_cast<std::uint32_t>(count), line.wind_speed()};
  const Columns columns = line.columns(begin, count);
  std::array<iovec, 1 + columns.size()> parts{{{&header, sizeof header}}};
  for (std::size_t c = 0; c < question_.columns; ++c)
    parts[1 + c] = {const_cast<float*>(columns[c].data()), columns[c].size_bytes()};
  CheckCall(WriteAll(socket_, std::span(parts).first(1 + question_.columns)), "send");
}

void RawConnection::Receive(AnswerMemory& answers, std::size_t begin, std::size_t count) {
  const std::size_t bytes = AnswerBytes(question_, count);
  if (begin_ + bytes > incoming_.size()) {
    std::memmove(incoming_.data(), incoming_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  while (end_ - begin_ < bytes) {
    const ssize_t received = recv(socket_, incoming_.data() + end_, incoming_.size() - end_, 0);
    CheckCall(received > 0, "recv");
    end_ += static_cast<std::size_t>(received);
  }
  answers.Put(question_, begin, count, incoming_.data() + begin_);
  begin_ += bytes;
  if (begin_ == end_) begin_ = end_ = 0;
}

}  // namespace albtpu::bench
