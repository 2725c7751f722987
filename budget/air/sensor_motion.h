// How the aircraft moved and was turned at the time of each pulse, and how well its trajectory is known there.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace albtpu {

struct SensorMotion {
  double roll = 0, pitch = 0;           // degree; 0 where a trajectory does not state them.
  double heading = 0;                   // degree, clockwise from true north; the course where it is not stated.
  std::array<double, 3> velocity = {};  // m/s; north, east, down.
  std::array<double, 3> rates = {};     // degree/s, about the forward, right and down axes of the aircraft.
  // One standard deviation; NaN where nothing states it.
  static constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();
  std::array<double, 3> position_sigma = {kNotKnown, kNotKnown, kNotKnown};  // m; north, east, down.
  std::array<double, 3> attitude_sigma = {kNotKnown, kNotKnown, kNotKnown};  // degree; roll, pitch, heading.
};

class SensorMotions {
 public:
  virtual ~SensorMotions() = default;

  // At a GPS time as the points state it; nullopt where the trajectory is not known. Any number of threads may call it
  // at a time.
  virtual std::optional<SensorMotion> At(double time) const = 0;
};

// s. Motions are those at the multiple of this that precedes a pulse. An aircraft that turns by 20 degrees a second is
// turned by 0.2 degrees in it, which changes a standard deviation by some 1e-3 of its part of the lever arm.
inline constexpr double kMotionStep = 0.01;

// Calls `use(i, motion)` for each time. Fast where times that follow each other are close. A time without a motion has
// that of no motion at all.
template <typename Use>
void ForEachMotion(const SensorMotions& motions, std::span<const double> times, Use use) {
  double last = std::numeric_limits<double>::quiet_NaN();
  SensorMotion motion;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double step = std::floor(times[i] / kMotionStep) * kMotionStep;
    if (step != last) {
      std::optional<SensorMotion> found = motions.At(step);
      if (!found.has_value()) found = motions.At(times[i]);  // The first step of a trajectory.
      motion = found.value_or(SensorMotion());
      last = step;
    }
    use(i, motion);
  }
}

}  // namespace albtpu
