// The water column in a total: from the settings of the user to the columns of a budget.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "annotate/answers/batch.h"
#include "budget/water/known_water.h"
#include "budget/water/water_columns.h"
#include "config/survey_settings.h"
#include "sea/water_index.h"

namespace albtpu::annotate {

// A number that a total takes, and where it comes from.

struct StatedNumber {
  std::string name, value, source;  // "scan", "0.02 degree", "riegl-vq-880-g: cBLUE 4.2"
  bool assumed = false;             // By albtpu, where neither the user nor the sensor's file says it.
};

// What a total takes of the water. The spread of a green surface is among the errors of the air side.
struct WaterPlan : CompiledWater {
  double index = kSeaWaterIndex;  // of the phase
  // Nothing says which laser located the surface by its returns. What the sensor's file says of its lasers.
  bool channel_assumed = false;
  std::string lasers = {};
};

// `index` is that of the plan. UsageError where the settings are incomplete or contradict each other, and what the
// table refuses. Adds to `numbers` what was taken and where from.
absl::StatusOr<WaterPlan> PlanWater(const config::WaterSettings& settings, double index,
                                    std::vector<StatedNumber>& numbers);

// Where a green laser located the surface: what this adds to the plan, and from pulse to pulse to the errors of the air
// side where each pulse's own return located it. Call it last. UsageError where the water or the receiver is not known.
absl::Status PlanGreenSurface(const config::SurveySettings& survey, BudgetOptions& options, WaterPlan& plan,
                              std::vector<StatedNumber>& numbers);

// The index that the user gives, or that of the temperature and salinity if both are given (refractive_index.h).
std::optional<double> IndexOf(const config::WaterSettings& water);
// The same, or that of sea water: the index of the geometry, of the air side and of the sea's share.
inline double IndexOrUsual(const config::WaterSettings& water) { return IndexOf(water).value_or(kSeaWaterIndex); }

// Restates the biases of the sea, as a table answers them, for the reported point (budget/total/reported_point.h);
// finds the water's share of pulses that have an answer of the sea, and adds its biases. Call it once for each answer.
// A pulse that the share does not know gets the outcome kNoWater and no biases.
void AddWater(const WaterPlan& plan, const PulseBatch& pulses, AnswerBatch& answers, WaterBatch& water);

}  // namespace albtpu::annotate
