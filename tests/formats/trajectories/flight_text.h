// A short flight as the text of an ASCII trajectory and as an SMRMSG, for tests. Each value can be replaced.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace albtpu::testing {

// One record in the units of an ASCII trajectory: degrees, metres, seconds.
struct FlightLine {
  double time, longitude, latitude, x, y, height, roll, pitch, heading;
  double velocity_east, velocity_north, velocity_up;
  double sigma_x, sigma_y, sigma_z, sigma_roll, sigma_pitch, sigma_heading;
};

// An aircraft at 400 m above the ellipsoid that flies straight with a crab angle of 3 degrees.
struct FlightSpec {
  std::size_t lines = 200;
  double start = 313200;                      // s of the week
  double rate = 50;                           // Hz
  double longitude = -80.6, latitude = 25.1;  // degree, at the start.
  double course = 344.4;                      // degree
  double speed = 56.5;                        // m/s
  std::size_t columns = 15;                   // Or 20.
  std::string separator = " ";
  std::string header = "";
  int decimals = 10;
  std::function<void(FlightLine&)> change = [](FlightLine&) {};  // Of every line before it is written.
};

FlightLine LineOf(const FlightSpec& spec, std::size_t line);
std::string FlightText(const FlightSpec& spec);

// The same flight as an SBET, whose wander frame is turned by 0.3 rad.
std::string SbetBytes(const FlightSpec& spec);

// Records of ten doubles, once a second from `start`: the value of field f of record i is 0.01 (f + 1) (1 + i / 10).
std::string SmrmsgBytes(double start, std::size_t records);

// Doubles as they lie in a file.
std::string Bytes(std::initializer_list<double> numbers);

}  // namespace albtpu::testing
