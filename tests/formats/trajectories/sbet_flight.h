// Flights in closed form, and the bytes of their SBETs. Shares no code with our reader.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

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

}  // namespace albtpu::testing
