// The record of an SBET, and its interpretation: the axes that its velocities are along.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "formats/trajectories/trajectory.h"

namespace albtpu::formats {

// As in the file. The wander frame is turned by the wander angle from north; velocities are along its axes, but for
// makers who write them along others (VelocityFrame).
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

// Two records of a short stretch without a gap (SpreadPairs).
struct SbetPair {
  SbetRecord first, second;
};

// What the user says of the axes: --velocity-axes.
enum class VelocityAxes { kAuto, kWander, kBody, kNorth };
inline constexpr std::array<std::string_view, 4> kVelocityAxesNames = {"auto", "wander", "body", "north"};

// The axes of the three velocities of a record.
enum class VelocityFrame {
  kWander,                   // North and west of the wander frame, up: what the format says.
  kForwardRightDown,         // Of the body, turned by roll, pitch and heading.
  kForwardLeftUp,            // The same with the other signs.
  kForwardRightDownOfLevel,  // Of the body as if it were level: turned by the heading alone.
  kForwardLeftUpOfLevel,
  kNorthEastDown,
  kNorthEastUp,
  kNorthWestUp,
  kNone,  // The record states none: all are 0 while the positions move.
};

// For messages: "the axes of the body (forward, right, down)".
std::string FrameText(VelocityFrame frame);

// Position, velocity in north, east and up, and true heading. In the wander frame of angle a,
//     v_N = v_x cos(a) - v_y sin(a),  v_E = -(v_x sin(a) + v_y cos(a)),  v_U = v_z,
// the signs that agree with differences of position in a real file (0.04 m/s rms; any other: 1.4-80 m/s). Along the
// axes of the body, (v_N, v_E, v_D) = Rz(heading) Ry(pitch) Rx(roll) (forward, right, down). kNone: not stated.
TrajectoryRecord TrajectoryRecordOf(const SbetRecord& record, VelocityFrame frame = VelocityFrame::kWander);

// The axes of the velocities, found by comparison with differences of position.
struct FoundFrame {
  VelocityFrame frame = VelocityFrame::kWander;
  // What the user should know: that velocities are not those of the format. Empty where they are.
  std::string remark;
};

// kAuto takes another frame than kWander only where kWander contradicts the positions (by more than 0.25 m/s rms) and
// the axes of the body agree with them at least four times better, or where all velocities are 0 and the positions
// move by more than 1 m/s rms. kBody and kNorth choose the order and the signs that agree best. Without pairs, kAuto is
// kWander, kBody forward, right and down, and kNorth north, east and down.
FoundFrame FindVelocityFrame(std::span<const SbetPair> pairs, VelocityAxes axes);

}  // namespace albtpu::formats
