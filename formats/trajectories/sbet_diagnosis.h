// Why velocities or headings of an SBET disagree with positions: the mistakes that occur, tried one by one.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "absl/status/status.h"
#include "formats/trajectories/sbet_record.h"

namespace albtpu::formats {

// The change of a file's numbers after which its velocities agree with its positions, worded for a message ("its
// latitude and longitude are exchanged"); nullopt if no known change does.
std::optional<std::string> VelocityCause(std::span<const SbetPair> pairs);

// InvalidArgument if velocities, whose axes are `frame`, differ from differences of position by more than
// kLargestVelocityDifference, if heights are in feet, if they fall where velocities are upwards, or if headings are
// turned against the courses by an angle that wind does not explain. Velocities of the frame kNone are not looked at.
absl::Status CheckSbetMotion(const std::string& name, std::span<const SbetPair> pairs,
                             VelocityFrame frame = VelocityFrame::kWander);

}  // namespace albtpu::formats
