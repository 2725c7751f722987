#include "quality/planning/depth_reach.h"

#include <cmath>
#include <numbers>

#include "annotate/totals/pulse_totals.h"
#include "annotate/totals/water_column.h"

namespace albtpu::quality {
namespace {

annotate::PulseBatch PulsesOf(const PlannedBeam& beam, double greatest_depth) {
  annotate::PulseBatch pulses;
  const auto set = [&](AxisId axis, std::optional<double> value) {
    if (value.has_value()) pulses[axis] = {static_cast<float>(*value)};
  };
  set(AxisId::kWindSpeed, beam.wind_speed);
  set(AxisId::kFetch, beam.fetch);
  set(AxisId::kIncidence, beam.incidence);
  set(AxisId::kFootprint, beam.footprint);
  for (double depth = kReachStep; depth <= greatest_depth; depth += kReachStep)
    pulses[AxisId::kDepth].push_back(static_cast<float>(depth));
  pulses.size = pulses[AxisId::kDepth].size();
  return pulses;
}

}  // namespace

double FootprintAt(double altitude, double incidence, double divergence) {
  return altitude / std::cos(incidence * std::numbers::pi / 180) * divergence / 1000;
}

absl::StatusOr<Reaches> ReachOf(const annotate::TotalPlan& plan, const annotate::AnswerSource& source,
                                const PlannedBeam& beam) {
  const annotate::PulseBatch pulses = PulsesOf(beam, source.table().axes[Index(AxisId::kDepth)].last);
  annotate::AnswerSelection selection;
  annotate::SelectForTotals(selection);
  annotate::AnswerBatch sea;
  if (absl::Status status = annotate::AnswerPulses(source, {}, pulses, selection, sea); !status.ok())
    return status;
  annotate::TotalBatch totals;
  annotate::AddWater(plan.water, pulses, sea, totals.water);
  AircraftColumns aircraft;
  aircraft[BudgetInput::kAltitude] = {static_cast<float>(beam.altitude)};
  annotate::ComputeTotals(plan, pulses, sea, aircraft, totals);
  Reaches reaches;
  for (std::size_t order = 0; order < reaches.size(); ++order) {
    Reach& reach = reaches[order];
    reach.limit = ReachLimit::kTable;  // Unless something else comes first.
    for (std::size_t i = 0; i < pulses.size; ++i) {
      if (!sea.interpolated(i)) {
        reach.limit = sea.outcomes[i] == annotate::kNoWater ? ReachLimit::kWater : ReachLimit::kTable;
        break;
      }
      const double depth = pulses.coordinate(AxisId::kDepth, i);
      if (totals.best_orders[i] == 0 || totals.best_orders[i] > order + 1) {
        const float bias = sea[Quantity::kBiasVertical][i];
        const double tvu = totals.tvu[i] + (std::isfinite(bias) ? std::abs(bias) : 0);
        reach.limit = tvu > TvuLimit(kS44Orders[order], depth) ? ReachLimit::kTvu : ReachLimit::kThu;
        break;
      }
      reach.depth = depth;
    }
  }
  return reaches;
}

}  // namespace albtpu::quality
