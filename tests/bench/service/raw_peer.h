// The minimum of a service of columns: the same numbers over plain TCP connections on this machine, answered by the
// same code, without schema, limits, deadlines or streams. It measures the cost of transferring the bytes. What fails
// ends the program with a message.
//
// A message is the number of pulses (uint32), the wind, and the columns of a question. Its answer is the quantities,
// the outcomes and their axes, each a column. Both are little-endian, for at most kMostRawPulses pulses.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tests/bench/service/flight_line.h"

namespace albtpu::bench {

// Ends the program with the message `what` unless `good`.
void Check(bool good, const std::string& what);

inline constexpr std::size_t kMostRawPulses = 65536;

using AnswerRaw =
    std::function<void(const float& wind_speed, const Columns& columns, float* numbers, std::uint8_t* outcomes)>;

// Listens on a free port, prints it, and serves each connection on its own thread until the process ends. Each answer
// is sent by a separate write.
[[noreturn]] void ServeRaw(const Question& question, const AnswerRaw& answer);

// A connection to a port, which sends at once.
class RawConnection {
 public:
  RawConnection(const std::string& port, const Question& question);
  ~RawConnection();
  RawConnection(const RawConnection&) = delete;

  void Send(const FlightLine& line, std::size_t begin, std::size_t count);
  // Receives the answer to the oldest unanswered message, whose pulses were the same.
  void Receive(AnswerMemory& answers, std::size_t begin, std::size_t count);

 private:
  int socket_;
  Question question_;
  std::vector<char> incoming_;
  std::size_t begin_ = 0, end_ = 0;  // Of the bytes that are received and not yet processed.
};

}  // namespace albtpu::bench
