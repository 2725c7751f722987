// From what the user and the sensor's file say to the plan of a total.
#pragma once

#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "survey/description/survey_description.h"
#include "survey/totals/total_plan.h"

namespace albtpu::client {

// What is known beside the survey file.
struct TotalContext {
  Coverage coverage = Coverage::kTwoSigma;
  std::optional<double> index = {};                     // Told by a flag; overrides the survey file.
  std::optional<std::array<double, 3>> lever_arm = {};  // The same.
  bool has_surface_returns = false;                     // Classes of returns from the surface are told.
  bool has_level = false;                               // A water level is told.
  std::string trajectory_errors =
      {};  // What states the errors of the trajectory pulse by pulse; empty: nothing does.
};

// That of a command without a surface of its own: what the survey file says.
TotalContext ContextOf(const SurveyDescription& survey, Coverage coverage);

// UsageError where a number is missing that nothing gives, where what is told contradicts itself, and where a part of
// the total is not decided, so that its name is true: the datum, and the water column or that it is left out.
// `survey.sensor` must have a name.
absl::StatusOr<TotalPlan> PlanTotal(const SurveyDescription& survey, const TotalContext& context);

// The wind sea by which a table of winds was made, for the height of waves that the location of the surface does not
// see. `spectrum` is the attribute of the table.
float WaveHeightOfWind(double wind_speed, std::optional<float> fetch, const std::string& spectrum);

}  // namespace albtpu::client
