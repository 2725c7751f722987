// The record of an SBET, and why velocities or headings disagree with positions: the mistakes that occur, tried one by
// one.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "absl/status/status.h"
#include "formats/trajectories/trajectory.h"

namespace albtpu::formats {

// The record of an SBET, and its interpretation.

// As in the file. The wander frame is turned by the wander angle from north; velocities are along its axes.
struct SbetRecord {
  double time = 0;                                // s of the GPS week, in GPS or UTC.
  double latitude = 0, longitude = 0;             // rad
  double height = 0;                              // m above the ellipsoid.
  double velocity_x = 0, velocity_y = 0;          // m/s, to the north and to the west of the wander frame.
  double velocity_z = 0;                          // m/s, up.
  double roll = 0, pitch = 0;                     // rad
  double platform_heading = 0;                    // rad, in the wander frame.
  double wander_angle = 0;                        // rad; true heading = platform heading - wander angle.
  double acceleration_x = 0, acceleration_y = 0;  // m/s^2, body axes.
  double acceleration_z = 0;                      // m/s^2
  double rate_x = 0, rate_y = 0, rate_z = 0;      // rad/s, body axes.
};
static_assert(sizeof(SbetRecord) == 136, "records are read as they lie in the file");

// Position, velocity in north, east and up, and true heading:
//     v_N = v_x cos(a) - v_y sin(a),  v_E = -(v_x sin(a) + v_y cos(a)),  v_U = v_z,
// the signs that agree with differences of position in a real file (0.04 m/s rms; any other: 1.4-80 m/s).
inline TrajectoryRecord TrajectoryRecordOf(const SbetRecord& record) {
  const double sine = std::sin(record.wander_angle), cosine = std::cos(record.wander_angle);
  TrajectoryRecord result;
  result.time = record.time;
  result.latitude = record.latitude;
  result.longitude = record.longitude;
  result.height = record.height;
  result.velocity_north = record.velocity_x * cosine - record.velocity_y * sine;
  result.velocity_east = -(record.velocity_x * sine + record.velocity_y * cosine);
  result.velocity_up = record.velocity_z;
  result.roll = record.roll;
  result.pitch = record.pitch;
  result.heading = record.platform_heading - record.wander_angle;
  result.rate_forward = record.rate_x;
  result.rate_right = record.rate_y;
  result.rate_down = record.rate_z;
  return result;
}

// Two records of a short stretch without a gap (SpreadPairs).
struct SbetPair {
  SbetRecord first, second;
};

// The change of a file's numbers after which its velocities agree with its positions, worded for a message ("its
// latitude and longitude are exchanged"); nullopt if no known change does.
std::optional<std::string> VelocityCause(std::span<const SbetPair> pairs);

// InvalidArgument if velocities differ from differences of position by more than kLargestVelocityDifference, if heights
// are in feet, or if headings are turned against the courses by an angle that wind does not explain.
absl::Status CheckSbetMotion(const std::string& name, std::span<const SbetPair> pairs);

}  // namespace albtpu::formats
