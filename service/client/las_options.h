// The flags of `albtpu-query las`, and what they ask for.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "service/client/las_annotation.h"
#include "service/client/options.h"

namespace albtpu::client {

// ASPRS, LAS Domain Profile for Topo-Bathy Lidar: class 40 is the bathymetric point (seafloor or
// riverbed; submerged topography).
inline constexpr int kBathymetricPoint = 40;

struct LasOptions {
  std::vector<std::string> files;
  std::string output_folder;
  std::set<int> classes = {kBathymetricPoint};
  std::optional<double> water_level, altitude, divergence, wind_from, flight_direction;
  std::optional<double> metres_per_unit;
  FixedCoordinates fixed;  // Wind speed, fetch, footprint, azimuth.
  SharedOptions shared;
};

// One file to annotate.
struct Job {
  std::filesystem::path input, output;
};

// `options` must live as long as `command`.
void AddLasOptions(CLI::App& command, LasOptions& options);

// IN OUT, or every input into the folder. IsUsageError when the files do not say which.
absl::StatusOr<std::vector<Job>> Jobs(const LasOptions& options);

// IsUsageError when something needed is missing, or is said in two ways.
absl::StatusOr<LasAnnotation> Annotation(const LasOptions& options);

}  // namespace albtpu::client
