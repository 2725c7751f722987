// Returns of one pulse that lie far apart in a file, as in one that is sorted by place: found by their times, in
// bounded memory.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace albtpu::annotate {

struct PulseReturn {
  std::uint64_t record = 0;  // Its number in the file.
  double time = 0;           // GPS time as the file states it.
  Eigen::Vector3d position;  // m, in the local frame.
  std::uint8_t number = 0, count = 0,
               channel = 0;  // Of the return, of the returns of its pulse, of the scanner.
  bool chosen = false;       // Of a chosen class.
};

// When there are too many returns, those of a random half of the pulses stay: the ones whose times have the smaller
// hashes. So all returns of a pulse stay or none, wherever they lie, and the sample depends on neither their order nor
// how they were divided.
class PulseSample {
 public:
  // Keeps at most `most` returns; while they are added, up to twice as many of 56 bytes.
  explicit PulseSample(std::size_t most = 1 << 19) : most_(most) {}

  void Add(const PulseReturn& pulse_return);

  // The returns of each pulse, side by side. Pulses of one return are left out, and those of equal times and channels
  // that cannot be separated: more returns than one pulse has, or two of one number.
  std::vector<std::vector<PulseReturn>> Take();

 private:
  void Thin();

  std::size_t most_;
  std::uint64_t limit_ = std::numeric_limits<std::uint64_t>::max();  // Upper bound of the hashes that stay.
  std::vector<PulseReturn> returns_;
};

}  // namespace albtpu::annotate
