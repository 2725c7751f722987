// How the total uncertainty of a survey is made: the errors of the air side, where the surface was located, the datum,
// and what of all this was assumed.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "annotate/totals/stated_number.h"
#include "annotate/totals/water_column.h"
#include "budget/total/budget_columns.h"

namespace albtpu::annotate {

struct TotalPlan {
  BudgetOptions options;
  std::vector<StatedNumber> numbers;
  WaterPlan water;
  std::optional<double> divergence;  // mrad, of the sensor; absent: no source gives it.
  // The standard deviations of position and attitude are those of each pulse, where its trajectory states them.
  bool position_by_pulse = false, attitude_by_pulse = false;
  // The axis of a sea that is known by its wind, degree clockwise from true north; absent: not known, or another sea.
  std::optional<float> sea_axis;
  // m, standard deviation of the elevation of a sea that is known by its wind.
  float wave_height = 0;
  // The height of the waves is not part of how the surface was located.
  bool waves_unseen() const { return options.located != SurfaceLocation::kPulse; }
};

// The divergence of the sensor as one of the numbers, for a plan that takes it because nothing else is given.
StatedNumber AssumedDivergence(double milliradians);

// As a summary states it: "sensor", "located", every number with its source.
nlohmann::ordered_json Parameters(const TotalPlan& plan);

// What was assumed, a line each: "attitude 0.005, 0.005, 0.008 degree (assumed: ...)".
std::vector<std::string> Assumptions(const TotalPlan& plan);

}  // namespace albtpu::annotate
