// Water levels by time, such as a tide gauge states them: a CSV file with the columns `time` and `water_level`.
//
//     time,water_level                         time,water_level
//     2016-05-11T14:00:00Z,-23.02              146968200.0,-23.02
//     2016-05-11T14:06:00Z,-23.05              146968560.0,-23.05
//
// `time` is UTC in ISO 8601 with its Z, or a number: GPS time in the form in which the LAS file states it. One file has
// one of the two. `water_level` is in the unit and in the vertical datum of the heights of the points. Others are
// ignored. Cells may be separated and numbers written as in formats/csv/csv_dialect.h.
//
// Or a file of CO-OPS (coops_levels.h), which states neither its datum nor, mostly, its time zone and unit.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "formats/trajectories/water_levels.h"

namespace albtpu::formats {

// What a file of levels does not state, by the user.
struct LevelReference {
  std::optional<std::string> datum = {};      // "MLLW", by name.
  double offset = 0;                          // Added to levels, from that datum to that of the points, in their unit.
  std::optional<double> hours_from_utc = {};  // Of times that state no zone: local time - UTC.
};

// Reads the text of such a file; `name` is for messages. At least two levels at increasing times.
absl::StatusOr<WaterLevelSeries> ParseWaterLevels(std::string name, std::string text,
                                                  const LevelReference& reference = {});

// Reads a CSV file of water levels.
absl::StatusOr<WaterLevelSeries> ReadWaterLevels(const std::filesystem::path& path,
                                                 const LevelReference& reference = {});

}  // namespace albtpu::formats
