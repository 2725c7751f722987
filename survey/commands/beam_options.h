// The options that say where each beam went, how wide it is and where the water surface is.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "command_line/cli_fwd.h"
#include "survey/beams/beam_plan.h"
#include "survey/commands/options.h"

namespace albtpu::client {

// As the user gave them.
struct BeamOptions {
  std::vector<std::string> trajectory, trajectory_errors;
  std::optional<std::string> trajectory_time, scanner, crs;
  bool from_returns = false;
  std::optional<std::array<double, 3>> lever_arm;
  std::optional<double> incidence, beam_azimuth, altitude, flight_direction, geoid_separation;
  std::optional<double> divergence, aperture, wind_from, water_index, metres_per_unit;
  std::optional<std::string> water_level;  // A number or a file.
  std::set<int> water_classes;
  FixedCoordinates fixed;  // wind speed, fetch, footprint, azimuth
};

// `options` must live as long as `command`.
void AddBeamOptions(CLI::App& command, BeamOptions& options);

// Classes of LAS points, separated by commas. Throws CLI::ValidationError.
std::set<int> ParseClasses(const std::string& flag, const std::string& text);

// IsUsageError if something needed is missing, is given in two ways or has no effect. `details`: the geometry of each
// beam is written, too. `any_sea`: the sea is told, by which the wind is its own.
absl::StatusOr<BeamPlan> MakePlan(const BeamOptions& options, bool details, bool any_sea);

}  // namespace albtpu::client
