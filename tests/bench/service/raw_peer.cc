#include "tests/bench/service/raw_peer.h"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iostream>

#include "tests/bench/service/raw_socket.h"

namespace albtpu::bench {
namespace {

constexpr std::array<AxisId, 4> kColumns = {AxisId::kIncidence, AxisId::kAzimuth, AxisId::kFootprint, AxisId::kDepth};
constexpr std::size_t kHeader = sizeof(std::uint32_t) + sizeof(float);

std::size_t RequestBytes(std::size_t count) { return kHeader + kColumns.size() * count * sizeof(float); }
std::size_t AnswerBytes(std::size_t count) { return count * (2 + kAskedQuantities * sizeof(float)); }

void Check(bool good, const char* what) {
  if (good) return;
  std::cerr << "service_bench: " << what << ": " << std::strerror(errno) << "\n";
  std::exit(1);
}

const float* FloatsAt(const char* bytes) { return reinterpret_cast<const float*>(bytes); }

PulseColumns ReadRequest(const char* bytes, std::size_t count) {
  PulseColumns pulses{.size = count, .axis = {}};
  pulses.axis[Index(AxisId::kWindSpeed)] = {FloatsAt(bytes + sizeof(std::uint32_t)), 1};
  for (std::size_t i = 0; i < kColumns.size(); ++i)
    pulses.axis[Index(kColumns[i])] = {FloatsAt(bytes + kHeader) + i * count, count};
  return pulses;
}

AnswerColumns AnswerIn(char* bytes, std::size_t count) {
  AnswerColumns answers;
  for (std::size_t q = 0; q < kAskedQuantities; ++q) answers.values[q] = reinterpret_cast<float*>(bytes) + q * count;
  answers.outcomes = reinterpret_cast<std::uint8_t*>(bytes) + kAskedQuantities * count * sizeof(float);
  answers.outcome_axes = answers.outcomes + count;
  return answers;
}

void Serve(int socket, const ColumnInterpolator& interpolator) {
  std::vector<char> requests(2 * RequestBytes(kMostRawPulses)), answer(AnswerBytes(kMostRawPulses));
  std::size_t have = 0;
  for (;;) {
    const ssize_t received = recv(socket, requests.data() + have, requests.size() - have, 0);
    if (received <= 0) break;
    have += static_cast<std::size_t>(received);
    std::size_t taken = 0;
    while (have - taken >= kHeader) {
      std::uint32_t count;
      std::memcpy(&count, requests.data() + taken, sizeof count);
      if (have - taken < RequestBytes(count)) break;
      interpolator.Interpolate({}, ReadRequest(requests.data() + taken, count), 0, count,
                               AnswerIn(answer.data(), count));
      if (!WriteAll(socket, answer.data(), AnswerBytes(count))) break;
      taken += RequestBytes(count);
    }
    have -= taken;
    std::memmove(requests.data(), requests.data() + taken, have);
  }
  close(socket);
}

}  // namespace

void ServeRaw(const ColumnInterpolator& interpolator) {
  ServeConnections([&interpolator](int socket) { Serve(socket, interpolator); });
}

RawConnection::RawConnection(const std::string& port)
    : socket_(ConnectTo(port)), outgoing_(RequestBytes(kMostRawPulses)), incoming_(2 * AnswerBytes(kMostRawPulses)) {}

RawConnection::~RawConnection() { close(socket_); }

void RawConnection::Send(const PulseColumns& pulses) {
  const auto count = static_cast<std::uint32_t>(pulses.size);
  std::memcpy(outgoing_.data(), &count, sizeof count);
  std::memcpy(outgoing_.data() + sizeof count, pulses[AxisId::kWindSpeed].data(), sizeof(float));
  char* column = outgoing_.data() + kHeader;
  for (AxisId axis : kColumns) {
    std::memcpy(column, pulses[axis].data(), count * sizeof(float));
    column += count * sizeof(float);
  }
  Check(WriteAll(socket_, outgoing_.data(), RequestBytes(count)), "send");
}

void RawConnection::Receive(std::size_t pulse_count, const AnswerColumns& answers) {
  const std::size_t bytes = AnswerBytes(pulse_count);
  if (begin_ + bytes > incoming_.size()) {
    std::memmove(incoming_.data(), incoming_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  while (end_ - begin_ < bytes) {
    const ssize_t received = recv(socket_, incoming_.data() + end_, incoming_.size() - end_, 0);
    Check(received > 0, "recv");
    end_ += static_cast<std::size_t>(received);
  }
  const AnswerColumns here = AnswerIn(incoming_.data() + begin_, pulse_count);
  for (std::size_t q = 0; q < kAskedQuantities; ++q)
    std::memcpy(answers.values[q], here.values[q], pulse_count * sizeof(float));
  std::memcpy(answers.outcomes, here.outcomes, pulse_count);
  std::memcpy(answers.outcome_axes, here.outcome_axes, pulse_count);
  begin_ += bytes;
  if (begin_ == end_) begin_ = end_ = 0;
}

}  // namespace albtpu::bench
