// A summary of a trajectory file, or of an error file: for people and for programs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "formats/trajectories/trajectory.h"

namespace albtpu::programs {

// The records of a file that are further apart than a limit.
struct TimeGaps {
  std::size_t count = 0;
  double longest = 0, longest_start = 0, total = 0;  // s
};

struct TrajectorySummary {
  std::string format;  // "SBET", "ASCII" or "SMRMSG".
  std::size_t records = 0;
  double start = 0, end = 0;  // s, as Trajectory::TimeAt.
  TimeGaps gaps;
  std::optional<double> min_height, max_height;   // m above the ellipsoid.
  std::optional<double> speed;                    // m/s over ground, median.
  std::optional<formats::TrajectorySigma> sigma;  // Medians.
  // Rms difference of stated velocities from those of the positions, m/s. A file whose difference is too large is not
  // summarized but refused.
  std::optional<double> velocity_difference;

  double duration() const { return end - start; }
  double rate() const;  // Records per second, gaps left out.
};

// Opens the file, whose format is detected by its content, checks it and reads all records.
absl::StatusOr<TrajectorySummary> SummarizeTrajectory(const std::filesystem::path& path);

// Lines of names and values with units, below the path.
std::string TrajectoryText(const std::string& path, const TrajectorySummary& summary);

// The object of a file in --json: numbers in s, m, m/s and degrees, null where there is none.
nlohmann::ordered_json TrajectoryJson(const std::string& path, const absl::StatusOr<TrajectorySummary>& summary);

}  // namespace albtpu::programs
