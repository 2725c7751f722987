// Why the velocities or headings of an SBET disagree with its positions: the mistakes that occur, tried one by one.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "formats/trajectories/sbet_record.h"

namespace albtpu::formats {

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
