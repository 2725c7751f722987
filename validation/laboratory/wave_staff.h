// A wave staff in an evolving sea: the record of elevations at one point.
#pragma once

#include <vector>

#include "generator/math/random_stream.h"
#include "sea/sea_state.h"

namespace albtpu {

// Immutable; draws from one staff may run on many threads. Records are exactly Gaussian, with the sea's
// spectrum over frequency: at one point the directions of waves do not matter. Each is cut from a periodic
// one twice as long, so that it does not repeat. The staff is quick: waves above half the rate are not
// filtered out but fold into the record.
class WaveStaff {
 public:
  WaveStaff(const SeaState& sea, int samples, double rate);  // rate in Hz

  std::vector<double> Draw(NormalStream stream) const;  // m

 private:
  int samples_;
  std::vector<double>
      power_;  // m^2, of the waves that turn so often in the period, or so often modulo its samples
};

}  // namespace albtpu
