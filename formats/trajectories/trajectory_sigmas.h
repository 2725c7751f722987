// Whether the standard deviations of a trajectory can be those of a navigation system, in the unit of their format.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>

#include "absl/status/status.h"
#include "formats/trajectories/trajectory.h"

namespace albtpu::formats {

// How a format states standard deviations, for messages.
struct SigmaColumns {
  std::array<std::string, kSigmaFields.size()> names = {};  // "column 13 'sigma roll'"
  std::string angle;                                        // The unit of angles: "degrees".
  double radians = 1;                                       // Of this unit.
  std::string if_unknown;                                   // What to do where they are not known.
};

// InvalidArgument, with the column, what it states and what would be right, where a column states only zeros, or
// positions, rolls or pitches that no navigation system has: in another unit. What is not stated counts for nothing,
// and velocities are not looked at. `of_record` is asked for the records below `size`.
absl::Status CheckSigmaUnits(const std::string& name, const SigmaColumns& columns, std::size_t size,
                             const std::function<TrajectorySigma(std::size_t)>& of_record);

}  // namespace albtpu::formats
