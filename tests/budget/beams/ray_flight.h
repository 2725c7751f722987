// A simulated flight of known truth, and the rays that pairs of returns tell of it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "budget/beams/return_pair.h"

namespace albtpu::testing {

enum class Scanner { kPalmer, kEllipse, kRaster };

// Waves of a wind sea: plane waves whose wavelengths are drawn from k^-3 above the peak, cos^2 around +x.
class SimulatedSea {
 public:
  SimulatedSea(double significant_wave_height, double peak_wavelength, std::uint64_t seed);
  double Elevation(const Eigen::Vector2d& x, double time) const;
  Eigen::Vector2d Slope(const Eigen::Vector2d& x, double time) const;

 private:
  struct Wave {
    Eigen::Vector2d k;
    double amplitude, frequency, phase;
  };
  std::vector<Wave> waves_;
};

struct FlightPlan {
  Scanner scanner = Scanner::kPalmer;
  double height = 400, speed = 60;  // m above the mean water, m/s
  double course = 0.3;              // rad, clockwise from north.
  double start = 1000, duration = 30;
  double pairs_per_second = 500;
  double water_height = -20;
  double point_noise = 0.02;  // m, of each coordinate of each return.
  double significant_wave_height = 0;
  double wander = 1;    // Amplitude of the slow motion around the straight line, relative to the usual.
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
  // The position of the sensor at any time, also before and after the flight.
  Eigen::Vector3d Position(double time) const;
  const FlightPlan& plan() const { return plan_; }
  std::vector<SimulatedRay> Rays() const;

 private:
  struct Swing {
    double amplitude, frequency, phase;
  };
  Eigen::Vector3d Attitude(double time) const;  // Roll, pitch, yaw [rad].
  Eigen::Vector3d Beam(double time) const;

  FlightPlan plan_;
  std::array<std::vector<Swing>, 3> motion_, attitude_;
};

std::vector<AirRay> RaysOf(const std::vector<SimulatedRay>& simulated);

// The incidence of the beam from `sensor` to `water_point`.
double IncidenceOf(const Eigen::Vector3d& sensor, const Eigen::Vector3d& water_point);

}  // namespace albtpu::testing
