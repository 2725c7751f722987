// The least that a service of columns can be: the same numbers over a bare TCP connection, answered by the
// same interpolator. No schema, no limits, no deadlines, no streams: what remains is what the bytes cost.
//
// A message is the number of pulses (uint32), the wind, and columns of incidence, azimuth, footprint and
// depth; its answer the columns of an AnswerMemory. Both little-endian, at most kMostRawPulses.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/bench/service/flight_line.h"

namespace albtpu::bench {

inline constexpr std::size_t kMostRawPulses = 65536;

// Listens on a free port of this machine, prints it, and serves each connection on a thread of its own until
// the process ends. Each message is answered by a write of its own.
void ServeRaw(const ColumnInterpolator& interpolator);

class RawConnection {
 public:
  explicit RawConnection(const std::string& port);
  ~RawConnection();
  RawConnection(const RawConnection&) = delete;

  void Send(const PulseColumns& pulses);
  // The answer of the oldest message that has none yet, of so many pulses.
  void Receive(std::size_t pulse_count, const AnswerColumns& answers);

 private:
  int socket_;
  std::vector<char> outgoing_, incoming_;
  std::size_t begin_ = 0, end_ = 0;  // Of what was received and not yet taken.
};

}  // namespace albtpu::bench
