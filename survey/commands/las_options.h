// The options of `albtpu-query las`.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>

#include "absl/status/statusor.h"
#include "survey/commands/options.h"
#include "survey/files/file_jobs.h"
#include "survey/las/las_annotation.h"

namespace albtpu::client {

// ASPRS, LAS Domain Profile for Topo-Bathy Lidar: class 40 is the bathymetric point (seafloor or
// riverbed; submerged topography).
inline constexpr int kBathymetricPoint = 40;

struct LasOptions {
  FileOptions files;
  std::set<int> classes = {kBathymetricPoint};
  std::optional<double> water_level, altitude, divergence, wind_from, flight_direction;
  std::optional<double> metres_per_unit;
  FixedCoordinates fixed;  // wind speed, fetch, footprint, azimuth
  Existing existing = Existing::kKeep;
  SourceOptions source;
  AnswerStyle style;
};

// `options` must live as long as `command`.
void AddLasOptions(CLI::App& command, LasOptions& options);

// IsUsageError if something needed is missing, or is given in two ways.
absl::StatusOr<LasAnnotation> Annotation(const LasOptions& options);

// The same as a summary states it.
nlohmann::ordered_json Parameters(const LasAnnotation& annotation);

}  // namespace albtpu::client
