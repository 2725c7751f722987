// The flags of `las` that say where each beam went and how wide it is, beside those that have a key in the survey file.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "annotate/beams/beam_plan.h"
#include "config/survey_draft.h"
#include "programs/command_line/cli_fwd.h"
#include "programs/query/survey_flags.h"

namespace albtpu::programs {

// A unit of heights by its word of --units.
struct HeightUnit {
  std::string_view name;
  double metres;  // Exact.
};
inline constexpr HeightUnit kMetre{"m", 1}, kFoot{"ft", 0.3048}, kSurveyFoot{"us-ft", 1200.0 / 3937.0};
inline constexpr std::array<HeightUnit, 3> kHeightUnits = {kMetre, kFoot, kSurveyFoot};

// As the user gave them.
struct BeamOptions {
  std::optional<std::string> scanner, crs;
  std::optional<double> incidence, beam_azimuth, altitude, flight_direction;
  std::optional<double> divergence, aperture, metres_per_unit;
  annotate::FixedInputs fixed;  // azimuth, footprint
};

// Adds them, and the flags of [trajectory], [surface], [water] and [datum] that `las` alone has. `options` and `flags`
// must live as long as `command`.
void AddBeamOptions(CLI::App& command, BeamOptions& options, SurveyFlags& flags);

// What these flags and settings leave open of the beams, the wind and the water surface. A flag is the section of a
// decision that no key closes.
std::vector<config::OpenDecision> OpenDecisionsOf(const BeamOptions& options, const config::SurveySettings& settings);

// Whether the flag of a way, such as --scanner, contradicts none of the given flags.
bool GoesWith(std::string_view flag_of_way, const BeamOptions& options, const config::SurveySettings& flags);

// Requires that nothing is open. IsUsageError if something is given in two ways or has no effect, of `flags` what is
// given by them.
// `details`: the geometry of each beam is written, too.
absl::StatusOr<annotate::BeamPlan> MakePlan(const BeamOptions& options, const config::SurveySettings& flags,
                                            const config::SurveySettings& settings, bool details);

}  // namespace albtpu::programs
