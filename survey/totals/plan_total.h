// From the settings of a survey and the sensor's file to the plan of a total.
#pragma once

#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "config/survey_settings.h"
#include "survey/totals/total_plan.h"

namespace albtpu::client {

// What is known beside the settings.
struct TotalContext {
  Coverage coverage = Coverage::kTwoSigma;
  bool has_surface_returns = false;  // Classes of returns from the surface are given.
  bool has_level = false;            // A water level is given.
  std::string trajectory_errors =
      {};  // What states the errors of the trajectory pulse by pulse; empty: nothing does.
  // All parts of a total must be decided, so that its name is true: the datum, and the water column or that it is left
  // out.
  bool decided = true;
};

// UsageError where a number is missing that nothing gives, where the settings contradict each other, and where a part
// of the total is not decided. `survey.sensor` must have a name.
absl::StatusOr<TotalPlan> PlanTotal(const config::SurveySettings& survey, const TotalContext& context);

// The wind sea by which a table of winds was made, for the height of waves that the location of the surface does not
// see. `spectrum` is the attribute of the table.
float WaveHeightOfWind(double wind_speed, std::optional<float> fetch, const std::string& spectrum);

}  // namespace albtpu::client
