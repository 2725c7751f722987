// Flights in closed form, as SBET, SMRMSG and ASCII trajectory. Shares no code with our readers.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "tests/flights/ellipsoid.h"

namespace albtpu::testing {

// The fields of an SBET record by their order in the file.
enum SbetField {
  kTime,
  kLatitude,
  kLongitude,
  kHeight,
  kVelocityX,
  kVelocityY,
  kVelocityZ,
  kRoll,
  kPitch,
  kPlatformHeading,
  kWander,
  kSbetFields = 17
};
using SbetRow = std::array<double, kSbetFields>;

// Latitude and longitude change by a constant rate and by a slow weave, the height by a wave. Angles in degrees.
struct Flight {
  double start = 300000, duration = 60, rate = 200;  // s, s, Hz
  double latitude = 26, longitude = -81.8, height = 400;
  double speed = 60, course = 30;      // m/s, degrees clockwise from north.
  double weave = 20, weave_time = 30;  // m, s
  double climb = 10;                   // m, with a period of 20 s.
  double roll = 3, pitch = -2;         // Amplitudes; the periods are 7 s and 9 s.
  double crab = 0;                     // Heading minus course.
  double wander = 20;
};

SbetRow RowAt(const Flight& flight, double time);  // s since the start.
std::vector<SbetRow> Fly(const Flight& flight);

std::string SbetBytes(const std::vector<SbetRow>& rows);

// The rows with a change applied to each.
std::vector<SbetRow> Changed(std::vector<SbetRow> rows, const std::function<void(SbetRow&)>& change);

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

// Records of ten doubles, once a second from `start`: the value of field f of record i is 0.01 (f + 1) (1 + i / 10).
std::string SmrmsgBytes(double start, std::size_t records);

// Doubles as they lie in a file.
std::string Bytes(std::initializer_list<double> numbers);

}  // namespace albtpu::testing
