// The position of the sensor at the time of each pulse, from a trajectory file or estimated from the returns.
#pragma once

#include <cstdint>
#include <span>

namespace albtpu {

// The position of the sensor in the coordinates of the points, and what turns differences of these coordinates into
// metres and true directions there.
struct SensorPosition {
  double x = 0, y = 0;  // In the horizontal unit of the points: metres, feet or degrees.
  double z = 0;         // m, in the vertical datum of the points.
  double metres_per_x = 1, metres_per_y = 1;  // True metres; the scale of a map projection is divided out.
  double convergence = 0;  // rad; the true azimuth of grid north: true azimuth = grid azimuth + convergence.
  double incidence_sigma =
      0;  // rad; standard deviation of incidences that this position causes; 0: not known.
};

enum class TrackOutcome : std::uint8_t {
  kKnown,
  kOutside,  // Before the first or after the last position, or in a gap between two: nothing is extrapolated.
  kUncertain,  // Too uncertain to be used (tracks from returns).
};

class SensorTrack {
 public:
  virtual ~SensorTrack() = default;

  // The positions at `times`, GPS times as the points state them. The three spans have equal lengths. Positions are
  // valid where the outcome is kKnown. Any number of threads may call it at a time. Fast where times that follow each
  // other are close.
  virtual void PositionsAt(std::span<const double> times, std::span<SensorPosition> positions,
                           std::span<TrackOutcome> outcomes) const = 0;
};

}  // namespace albtpu
