// A simulated flight of known truth over a plane, and the rays that pairs of returns tell of it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "budget/beams/return_pair.h"
#include "tests/flights/aircraft.h"

namespace albtpu::testing {

struct FlightPlan {
  ScannerKind scanner = ScannerKind::kCone;
  double height = 400, speed = 60;  // m above the mean water, m/s
  double course = 0.3;              // rad, clockwise from north.
  double start = 1000, duration = 30;
  double pairs_per_second = 500;
  double water_height = -20;
  double point_noise = 0.02;  // m, of each coordinate of each return.
  double significant_wave_height = 0;
  double drift = 1;     // The motion around the straight line, relative to the usual.
  double outliers = 0;  // Share of pairs whose lower return belongs elsewhere.
  std::uint64_t seed = 1;
};

struct SimulatedRay {
  AirRay ray;
  Eigen::Vector3d true_water_point;  // Where the beam met the mean water level.
};

class SimulatedFlight {
 public:
  explicit SimulatedFlight(const FlightPlan& plan);
  // The position of the sensor at any time, also before and after the flight: east, north, up.
  Eigen::Vector3d Position(double time) const;
  const FlightPlan& plan() const { return plan_; }
  std::vector<SimulatedRay> Rays() const;

 private:
  FlightPlan plan_;
  Aircraft aircraft_;
  std::vector<SmoothMotion> swings_;  // m east, north and up
};

std::vector<AirRay> RaysOf(const std::vector<SimulatedRay>& simulated);

// What a track knows of these times.
struct TrackAnswer {
  std::vector<SensorPosition> positions;
  std::vector<TrackOutcome> outcomes;
};
template <typename Track>
TrackAnswer Ask(const Track& track, const std::vector<double>& times) {
  TrackAnswer answer = {std::vector<SensorPosition>(times.size()), std::vector<TrackOutcome>(times.size())};
  track.PositionsAt(times, answer.positions, answer.outcomes);
  return answer;
}

// The incidence of the beam from `sensor` to `water_point`.
double IncidenceOf(const Eigen::Vector3d& sensor, const Eigen::Vector3d& water_point);

}  // namespace albtpu::testing
