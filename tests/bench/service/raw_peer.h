// The minimum of a service of columns: the same numbers over a plain TCP connection, answered by the same interpolator,
// without schema, limits, deadlines or streams. It measures the cost of transferring the bytes.
//
// A message is the number of pulses (uint32), the wind, and columns of incidence, azimuth, footprint and depth. Its
// answer is the columns of an AnswerMemory. Both are little-endian, for at most kMostRawPulses pulses.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/service/flight_line.h"

namespace albtpu::bench {

inline constexpr std::size_t kMostRawPulses = 65536;

// Listens on a free port of this machine, prints it, and serves each connection on its own thread until the process
// ends. Each answer is sent by a separate write.
void ServeRaw(const ColumnInterpolator& interpolator);

class RawConnection {
 public:
  explicit RawConnection(const std::string& port);
  ~RawConnection();
  RawConnection(const RawConnection&) = delete;

  void Send(const PulseColumns& pulses);
  // Receives the answer to the oldest unanswered message, which had `pulse_count` pulses.
  void Receive(std::size_t pulse_count, const AnswerColumns& answers);

 private:
  int socket_;
  std::vector<char> outgoing_, incoming_;
  std::size_t begin_ = 0, end_ = 0;  // of the bytes that are received and not yet processed
};

}  // namespace albtpu::bench
