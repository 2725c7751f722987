// The depths that a flight can reach, over the sea and each of the conditions that a planner chooses.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "quality/planning/depth_reach.h"

namespace albtpu::quality {

// A condition that is varied beside the sea, while the others keep their planned values.
struct PlannedAxis {
  std::string name, unit;  // "altitude", "m"
  std::vector<double> values;
  std::vector<std::vector<Reaches>> reaches;  // By value, then by sea.
};

struct SurveyPlan {
  S44Order order = S44Order::k1a;  // The required order.
  std::string sea_name, sea_unit;  // "wind_speed", "m/s"; or "significant_wave_height", "m"
  std::vector<double> seas;
  std::vector<Reaches> planned;  // By sea, under the planned conditions.
  std::vector<PlannedAxis> axes;
  double altitude = 0, incidence = 0;           // The planned conditions: m, degree.
  std::vector<annotate::StatedNumber> numbers;  // Of the total, with their sources.
};

// The highest sea state of `plan` at which the order is met from 0 to `depth` under planned conditions, and at all
// lower ones; absent if it is met at none.
std::optional<double> HighestSea(const SurveyPlan& plan, S44Order order, double depth);

// {"order", "sea", "seas", "conditions", "planned": [by sea {"depth": {"1a": m, ...}, "limited_by": {"1a": ...}}],
//  "greatest_sea": [{"depth", "1a", ...}],
//  "axes": [{"name", "unit", "values", "depth": {"1a": [by value [by sea]], ...}, "limited_by": the same}], "numbers"}.
// imited_by" is of kReachLimitNames; a depth is null where no table covers the beam or the sea.
nlohmann::ordered_json PlanJson(const SurveyPlan& plan);

// A table of the planned conditions, and the highest sea state at each depth.
std::string PlanText(const SurveyPlan& plan);

}  // namespace albtpu::quality
