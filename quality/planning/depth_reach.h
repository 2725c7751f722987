// The depth down to which the orders of S-44 can be met, for planned conditions.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "annotate/answers/batch.h"
#include "annotate/totals/total_plan.h"
#include "tables/s44.h"

namespace albtpu::quality {

// The beam of a flight over one sea. The direction of the beam relative to the wind is not known: the worse one counts.
struct PlannedBeam {
  double altitude = 0;   // m above the water
  double incidence = 0;  // degree
  double footprint = 0;  // m, diameter at the water, across the beam
  // Of a table of winds; absent over a sea with waves of its own.
  std::optional<double> wind_speed, fetch;  // m/s, m
};

// m: footprint of a beam with this full angle of divergence in mrad.
double FootprintAt(double altitude, double incidence, double divergence);

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

// By order, at depths of kReachStep. `plan` has the coverage p95. `kTable`: the table of the sea, or the sea, has no
// answer deeper or for this beam at all; `kWater`: that of the water column has none.
inline constexpr double kReachStep = 0.25;  // m
absl::StatusOr<Reaches> ReachOf(const annotate::TotalPlan& plan, const annotate::AnswerSource& source,
                                const PlannedBeam& beam);

}  // namespace albtpu::quality
