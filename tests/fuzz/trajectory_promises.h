// What trajectory.h promises of a trajectory that was opened, and what a message must have.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "absl/strings/match.h"
#include "formats/trajectories/trajectory.h"
#include "tests/fuzz/fuzz_target.h"

namespace albtpu::fuzz {

// One line that begins with the name of the file and says more.
inline void MustExplain(const absl::Status& status, const std::string& name) {
  ALBTPU_MUST(absl::IsInvalidArgument(status) || absl::IsDataLoss(status));
  ALBTPU_MUST(absl::StartsWith(status.message(), name) && status.message().size() > name.size() + 10);
}

inline void MustKeepPromises(const formats::Trajectory& trajectory) {
  ALBTPU_MUST(trajectory.size() >= 2);
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const formats::TrajectoryRecord record = trajectory.Record(i);
    ALBTPU_MUST(std::isfinite(record.time) && record.time == trajectory.TimeAt(i));
    ALBTPU_MUST(i == 0 || record.time > trajectory.TimeAt(i - 1));
    ALBTPU_MUST(std::abs(record.latitude) <= std::numbers::pi / 2 && std::isfinite(record.longitude));
    ALBTPU_MUST(std::isfinite(record.height));
    ALBTPU_MUST(std::isfinite(record.roll) && std::isfinite(record.pitch) && std::isfinite(record.heading));
    const std::optional<formats::TrajectorySigma> sigma = trajectory.SigmaAt(i);
    if (!sigma.has_value()) continue;
    for (const double value : {sigma->north, sigma->east, sigma->down, sigma->roll, sigma->pitch, sigma->heading})
      ALBTPU_MUST(value >= 0 && std::isfinite(value));
  }
}

}  // namespace albtpu::fuzz
