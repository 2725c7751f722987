// The plan of a total, made from the settings of a survey and the file of its sensor.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "annotate/totals/water_column.h"
#include "budget/total/budget_columns.h"
#include "config/survey_settings.h"

namespace albtpu::config {
struct OpenDecision;
}  // namespace albtpu::config

namespace albtpu::annotate {

// How the total uncertainty of a survey is made: the errors of the air side, where the surface was located, the datum,
// and what of all this was assumed.

struct TotalPlan {
  BudgetOptions options;
  std::vector<StatedNumber> numbers;
  WaterPlan water;
  double hard_range = 0;             // m, standard deviation of the range to a hard target, such as dry land.
  std::optional<double> divergence;  // mrad, of the sensor; absent: no source gives it.
  // The standard deviations of position and attitude are those of each pulse, where its trajectory states them.
  bool position_by_pulse = false, attitude_by_pulse = false;
  // The axis of a sea that is known by its wind, degree clockwise from true north; absent: not known, or another sea.
  std::optional<float> sea_axis;
  // m, standard deviation of the elevation of a sea that is known by its wind.
  float wave_height = 0;
  bool has_extra() const { return options.extra_horizontal > 0 || options.extra_vertical > 0; }
  // The height of the waves is not part of how the surface was located.
  bool waves_unseen() const { return options.located != SurfaceLocation::kPulse; }
};

// The divergence of the sensor as one of the numbers, for a plan that takes it because nothing else is given.
StatedNumber AssumedDivergence(double milliradians);

// As a summary states it: "sensor", "located", every number with its source.
nlohmann::ordered_json Parameters(const TotalPlan& plan);

// What was assumed, a line each: "attitude 0.005, 0.005, 0.008 degree (assumed: ...)".
std::vector<std::string> Assumptions(const TotalPlan& plan);

// What was entered of the water, what it became and by which formula, as a line, of `parameters` of a plan; or that
// the water column is left out.
std::string WaterText(const nlohmann::ordered_json& parameters);

// What is known beside the settings.
struct TotalContext {
  Coverage coverage = Coverage::kTwoSigma;
  bool has_surface_returns = false;    // Classes of returns from the surface are given.
  bool has_level = false;              // A water level is given.
  std::string trajectory_errors = {};  // What states the errors of the trajectory pulse by pulse; empty: nothing does.
};

// That of a command without a surface of its own: what the settings say.
TotalContext ContextOf(const config::SurveySettings& survey, Coverage coverage);

// What a total leaves open: the datum, and the water column or that it is left out, without which its name would not be
// true; how the surface was located; the numbers that no source gives, if the sensor is named and known.
std::vector<config::OpenDecision> UndecidedOf(const config::SurveySettings& survey, const TotalContext& context);

// UsageError where something is not decided or the settings contradict each other.
// Also where the survey has several scanners and none is named.
absl::StatusOr<TotalPlan> PlanTotal(const config::SurveySettings& survey, const TotalContext& context);

// The trajectory states its own standard deviations of `source`, position or attitude. They count pulse by pulse where
// [sigma] does not say otherwise.
void TakeErrorsOfTrajectory(std::string_view source, TotalPlan& plan);

// The spectrum by which a table of winds was made, an attribute; empty if it does not state it.
std::string SpectrumOf(const client::TableSummary& table);

// The standard deviation of the elevation of the wind sea of this spectrum, m, for the waves that the location of the
// surface does not see.
float WaveHeightOfWind(double wind_speed, std::optional<float> fetch, const std::string& spectrum);

}  // namespace albtpu::annotate
