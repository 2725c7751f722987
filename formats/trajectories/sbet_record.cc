#include "formats/trajectories/sbet_record.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "formats/trajectories/ascii_motion.h"

namespace albtpu::formats {
namespace {

using enum VelocityFrame;

// m/s rms. In a right SBET, velocities and positions of one solution differ by less (0.04 in a real file).
constexpr double kContradiction = 0.25;
constexpr double kMuchBetter = 4;
// m/s rms of the positions, above which velocities of 0 cannot be true.
constexpr double kMoving = 1;

constexpr std::array kBodyFrames = {kForwardRightDown, kForwardLeftUp, kForwardRightDownOfLevel, kForwardLeftUpOfLevel};
constexpr std::array kNorthFrames = {kNorthEastDown, kNorthEastUp, kNorthWestUp};

struct Vector {
  double x = 0, y = 0, z = 0;
};

// Rz(heading) Ry(pitch) Rx(roll) of forward, right and down.
Vector OfBody(const Vector& body, double roll, double pitch, double heading) {
  const double right = body.y * std::cos(roll) - body.z * std::sin(roll);
  const double below = body.y * std::sin(roll) + body.z * std::cos(roll);
  const double forward = body.x * std::cos(pitch) + below * std::sin(pitch);
  return {forward * std::cos(heading) - right * std::sin(heading),
          forward * std::sin(heading) + right * std::cos(heading), -body.x * std::sin(pitch) + below * std::cos(pitch)};
}

// North, east and down.
Vector VelocityOf(const SbetRecord& record, VelocityFrame frame) {
  const Vector v = {record.velocity_x, record.velocity_y, record.velocity_z};
  const double heading = record.platform_heading - record.wander_angle;
  switch (frame) {
    case kWander: {
      const double sine = std::sin(record.wander_angle), cosine = std::cos(record.wander_angle);
      return {v.x * cosine - v.y * sine, -(v.x * sine + v.y * cosine), -v.z};
    }
    case kForwardRightDown:
      return OfBody(v, record.roll, record.pitch, heading);
    case kForwardLeftUp:
      return OfBody({v.x, -v.y, -v.z}, record.roll, record.pitch, heading);
    case kForwardRightDownOfLevel:
      return OfBody(v, 0, 0, heading);
    case kForwardLeftUpOfLevel:
      return OfBody({v.x, -v.y, -v.z}, 0, 0, heading);
    case kNorthEastDown:
      return v;
    case kNorthEastUp:
      return {v.x, v.y, -v.z};
    case kNorthWestUp:
      return {v.x, -v.y, -v.z};
    case kNone:
      break;
  }
  return {kNotStated, kNotStated, kNotStated};
}

double Difference(std::span<const SbetPair> pairs, VelocityFrame frame) {
  std::vector<VelocityPair> velocities;
  velocities.reserve(pairs.size());
  for (const SbetPair& pair : pairs)
    velocities.push_back(
        CompareVelocities(TrajectoryRecordOf(pair.first, frame), TrajectoryRecordOf(pair.second, frame)));
  return VelocityDifference(velocities);
}

struct Fit {
  VelocityFrame frame;
  double difference;
};

// The first of equal ones.
Fit BestOf(std::span<const SbetPair> pairs, std::span<const VelocityFrame> frames) {
  Fit best = {frames.front(), HUGE_VAL};
  for (const VelocityFrame frame : frames) {
    const double difference = Difference(pairs, frame);
    if (difference < best.difference) best = {frame, difference};
  }
  return best;
}

bool IsAtRest(const SbetRecord& record) {
  return record.velocity_x == 0 && record.velocity_y == 0 && record.velocity_z == 0;
}

bool AreLeftOut(std::span<const SbetPair> pairs) {
  return std::all_of(pairs.begin(), pairs.end(),
                     [](const SbetPair& pair) { return IsAtRest(pair.first) && IsAtRest(pair.second); }) &&
         Difference(pairs, kWander) > kMoving;
}

std::string Turned(const Fit& fit, double wander) {
  return absl::StrFormat(
      "its velocities are along %s and were turned (so they differ from its positions by %.2f m/s rms, along the "
      "wander frame of an SBET by %.2f m/s)",
      FrameText(fit.frame), fit.difference, wander);
}

}  // namespace

std::string FrameText(VelocityFrame frame) {
  switch (frame) {
    case kWander:
      return "the wander frame";
    case kForwardRightDown:
      return "the axes of the body (forward, right, down)";
    case kForwardLeftUp:
      return "the axes of the body (forward, left, up)";
    case kForwardRightDownOfLevel:
      return "the axes of the body without its roll and pitch (forward, right, down)";
    case kForwardLeftUpOfLevel:
      return "the axes of the body without its roll and pitch (forward, left, up)";
    case kNorthEastDown:
      return "north, east and down";
    case kNorthEastUp:
      return "north, east and up";
    case kNorthWestUp:
      return "north, west and up";
    case kNone:
      break;
  }
  return "no axes";
}

TrajectoryRecord TrajectoryRecordOf(const SbetRecord& record, VelocityFrame frame) {
  const Vector velocity = VelocityOf(record, frame);
  TrajectoryRecord result;
  result.time = record.time;
  result.latitude = record.latitude;
  result.longitude = record.longitude;
  result.height = record.height;
  result.velocity_north = velocity.x;
  result.velocity_east = velocity.y;
  result.velocity_up = -velocity.z;
  result.roll = record.roll;
  result.pitch = record.pitch;
  result.heading = record.platform_heading - record.wander_angle;
  result.rate_forward = record.rate_x;
  result.rate_right = record.rate_y;
  result.rate_down = record.rate_z;
  return result;
}

FoundFrame FindVelocityFrame(std::span<const SbetPair> pairs, VelocityAxes axes) {
  if (axes == VelocityAxes::kWander) return {};
  if (pairs.empty())
    return {axes == VelocityAxes::kBody    ? kForwardRightDown
            : axes == VelocityAxes::kNorth ? kNorthEastDown
                                           : kWander,
            ""};
  if (axes == VelocityAxes::kAuto && AreLeftOut(pairs))
    return {kNone, "its velocities are all 0 while its positions move; they were derived from the positions"};
  const double wander = Difference(pairs, kWander);
  if (axes != VelocityAxes::kAuto) {
    const Fit fit = axes == VelocityAxes::kBody ? BestOf(pairs, kBodyFrames) : BestOf(pairs, kNorthFrames);
    return {fit.frame, Turned(fit, wander)};
  }
  if (wander <= kContradiction) return {};
  const Fit body = BestOf(pairs, kBodyFrames);
  if (!(body.difference * kMuchBetter < wander && body.difference <= kLargestVelocityDifference)) return {};
  // Along north already, and flown to the north: the axes of the body may agree as well, and are not known then.
  if (BestOf(pairs, kNorthFrames).difference < kMuchBetter * body.difference) return {};
  return {body.frame, Turned(body, wander)};
}

}  // namespace albtpu::formats
