// The depths to which the orders of S-44 can be met by a planned flight, over the sea and each of the conditions that a
// planner chooses.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "annotate/answers/batch.h"
#include "annotate/totals/plan_total.h"
#include "tables/s44.h"

namespace albtpu::quality {

// The depth down to which the orders of S-44 can be met, for planned conditions.

// The beam of a flight over one sea. The direction of the beam relative to the wind is not known: the worse one counts.
struct PlannedBeam {
  double altitude = 0;   // m above the water
  double incidence = 0;  // degree
  double footprint = 0;  // m, diameter at the water, across the beam
  // Of a table of winds; absent over a sea with waves of its own.
  std::optional<double> wind_speed, fetch;  // m/s, m
  std::optional<double> time = {};          // s since 1970, UTC, of a sea that goes by time
};

// What limits the depth to which an order is met.
enum class ReachLimit { kThu, kTvu, kTable, kWater };
inline constexpr std::array<std::string_view, 4> kReachLimitNames = {"thu", "tvu", "table", "water"};

struct Reach {
  double depth = 0;  // m: the order is met at all depths from 0 to here.
  ReachLimit limit = ReachLimit::kTvu;

  // Otherwise no table covers the beam or the sea at any depth.
  bool is_known() const { return depth > 0 || limit == ReachLimit::kThu || limit == ReachLimit::kTvu; }
};
using Reaches = std::array<Reach, kS44Orders.size()>;

inline const Reach& Of(const Reaches& reaches, S44Order order) { return reaches[static_cast<std::size_t>(order)]; }
inline std::string LimitName(const Reach& reach) {
  return std::string(kReachLimitNames[static_cast<std::size_t>(reach.limit)]);
}

// By order, at depths of kReachStep. `plan` has the coverage p95. `kTable`: the table of the sea, or the sea, has no
// answer deeper or for this beam at all; `kWater`: that of the water column has none.
inline constexpr double kReachStep = 0.25;  // m
absl::StatusOr<Reaches> ReachOf(const annotate::TotalPlan& plan, const annotate::AnswerSource& source,
                                const PlannedBeam& beam);

// A condition that is varied beside the sea, while the others keep their planned values.
struct PlannedAxis {
  std::string name, unit;  // "altitude", "m"
  std::vector<double> values;
  std::vector<std::vector<Reaches>> reaches;  // By value, then by sea, or by hour.
};

// The whole hours of a series of seas, in place of single seas.
struct PlannedHours {
  double first = 0, last = 0;   // s since 1970, UTC
  std::size_t without_sea = 0;  // Of these, in gaps of the series.
};

// Of hours with a sea: the fraction in which an order is met from 0 to a depth, and the fraction of which that is not
// known, because no table answers so deep.
struct HoursMet {
  double met = 0, unknown = 0;
};
HoursMet ShareOfHours(const std::vector<Reaches>& by_hour, S44Order order, double depth);

inline constexpr std::array<double, 8> kAskedDepths = {1, 2, 5, 10, 15, 20, 30, 40};  // m

struct SurveyPlan {
  S44Order order = S44Order::k1a;  // The required order.
  std::string sea_name, sea_unit;  // "wind_speed", "m/s"; or "significant_wave_height", "m"
  std::vector<double> seas;
  std::optional<PlannedHours> hours;  // Then there are no `seas`, and what follows is by hour with a sea.
  std::vector<Reaches> planned;       // By sea, under the planned conditions.
  std::vector<PlannedAxis> axes;
  double altitude = 0, incidence = 0;           // The planned conditions: m, degree.
  std::string located, located_by;              // How the water surface is located, as in a summary; who says so.
  std::vector<annotate::StatedNumber> numbers;  // Of the total, with their sources.
};

// The highest sea state of `plan` at which the order is met from 0 to `depth` under planned conditions, and at all
// lower ones; absent if it is met at none.
std::optional<double> HighestSea(const SurveyPlan& plan, S44Order order, double depth);

// {"order", "sea", "seas", "conditions", "planned": [by sea {"depth": {"1a": m, ...}, "limited_by": {"1a": ...}}],
//  "greatest_sea": [{"depth", "1a", ...}],
//  "axes": [{"name", "unit", "values", "depth": {"1a": [by value [by sea]], ...}, "limited_by": the same}], "located",
//  "numbers"}.
// "limited_by" is of kReachLimitNames; a depth is null where no table covers the beam or the sea. Of hours, "planned",
// "greatest_sea" and "seas" are empty, there is "hours": {"first", "last", "count", "without_sea", "tides",
// "by_depth": [{"depth", "share": {"1a": fraction, ...}, "no_answer": {...}}]}, and axes have "share": {"1a": [by value
// [by depth of "by_depth"]], ...} in place of "depth" and "limited_by".
nlohmann::ordered_json PlanJson(const SurveyPlan& plan);

// A table of the planned conditions, the highest sea state at each depth, and a table for each axis; of hours, their
// shares.
std::string PlanText(const SurveyPlan& plan);

}  // namespace albtpu::quality
