#include "generator/table_maker.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "generator/angle.h"
#include "generator/closed_form.h"
#include "generator/provenance.h"
#include "generator/random_stream.h"
#include "generator/rounding.h"
#include "tables/interpolation.h"

namespace albtpu {
namespace {

// Variables of a table while they are filled in, one beam after another.
class VariableGrid {
 public:
  VariableGrid(const Campaign& campaign, std::vector<Quantity> quantities, bool standard_errors)
      : campaign_(campaign) {
    for (const Quantity quantity : quantities) {
      Variable& variable = variables_[Index(quantity)].emplace();
      variable.values.resize(ValueCount(campaign.axes, quantity));
      if (standard_errors) variable.standard_errors.resize(variable.values.size());
    }
  }

  // `beam` counts the beams of the encounter, `depth` the nodes of its axis: 0 for quantities without depth.
  void Set(Quantity quantity, std::size_t encounter, std::size_t beam, std::size_t depth,
           const Estimate& estimate) {
    Variable& variable = *variables_[Index(quantity)];
    const std::size_t footprints = campaign_.nodes(AxisId::kFootprint).size();
    const std::size_t beams =
        campaign_.nodes(AxisId::kIncidence).size() * campaign_.nodes(AxisId::kAzimuth).size();
    const std::size_t depths = Describe(quantity).over_depth ? campaign_.nodes(AxisId::kDepth).size() : 1;
    const std::size_t sea = encounter / footprints, footprint = encounter % footprints;
    const std::size_t at = ((sea * beams + beam) * footprints + footprint) * depths + depth;
    if (variable.standard_errors.empty()) {
      variable.values[at] = static_cast<float>(estimate.value);
      return;
    }
    const auto [value, standard_error] = Rounded(estimate);
    variable.values[at] = static_cast<float>(value);
    variable.standard_errors[at] = static_cast<float>(standard_error);
  }

  UncertaintyTable::Variables Take() { return std::move(variables_); }

 private:
  const Campaign& campaign_;
  UncertaintyTable::Variables variables_;
};

Estimate InDegrees(const Estimate& radians) {
  return {DegreesOfRadians(radians.value), DegreesOfRadians(radians.standard_error)};
}

void Store(const BeamUncertainty& result, std::size_t encounter, std::size_t beam, VariableGrid& grid) {
  grid.Set(Quantity::kRefractionAlongWind, encounter, beam, 0, InDegrees(result.refraction_along_wind));
  grid.Set(Quantity::kRefractionCrossWind, encounter, beam, 0, InDegrees(result.refraction_cross_wind));
  for (std::size_t d = 0; d < result.thu.size(); ++d) {
    grid.Set(Quantity::kThu, encounter, beam, d, result.thu[d]);
    grid.Set(Quantity::kTvu, encounter, beam, d, result.tvu[d]);
    grid.Set(Quantity::kBiasAlongBeam, encounter, beam, d, result.bias_along_beam[d]);
    grid.Set(Quantity::kBiasVertical, encounter, beam, d, result.bias_vertical[d]);
  }
}

// A coordinate the fraction `t` of the way along an axis, in its scale.
float AlongAxis(const Axis& axis, double t) {
  const double first = axis.nodes().front(), last = axis.nodes().back();
  const double x =
      axis.scale() == Scale::kLog ? first * std::pow(last / first, t) : first + t * (last - first);
  return static_cast<float>(std::clamp(x, first, last));
}

SmallSlopeUncertainty ClosedFormOf(const Campaign& campaign, const Pulse& pulse) {
  SeaOptions sea = campaign.sea;
  sea.wind_speed_10m = pulse.wind_speed;
  sea.fetch = pulse.fetch;
  return ClosedForm(SeaState(sea),
                    {.incidence = RadiansOfDegrees(pulse.incidence),
                     .azimuth = RadiansOfDegrees(*pulse.azimuth),
                     .footprint = pulse.footprint,
                     .profile = campaign.profile},
                    campaign.refractive_index);
}

}  // namespace

absl::StatusOr<UncertaintyTable> MakeTable(const Campaign& campaign,
                                           const std::function<void(std::size_t)>& done) {
  VariableGrid grid(campaign, {kQuantities.begin(), kQuantities.end()}, true);
  std::vector<EncounterResult> results(EncounterCount(campaign));
  std::mutex reporting;
  std::size_t finished = 0;
  // Two levels: what an encounter prepares alone, others fill with their surfaces.
  tbb::parallel_for(std::size_t{0}, results.size(), [&](std::size_t i) {
    EncounterResult result =
        Simulate(EncounterOf(campaign, i), campaign.effort, campaign.seed, static_cast<std::uint32_t>(i));
    for (std::size_t beam = 0; beam < result.beams.size(); ++beam) Store(result.beams[beam], i, beam, grid);
    result.beams.clear();
    results[i] = std::move(result);
    const std::lock_guard lock(reporting);
    done(++finished);
  });
  const absl::StatusOr<InterpolationError> interpolation_error = MeasureInterpolationError(campaign);
  if (!interpolation_error.ok()) return interpolation_error.status();
  return UncertaintyTable::Create(campaign.axes, grid.Take(),
                                  MakeProvenance(campaign, results, *interpolation_error));
}

absl::StatusOr<UncertaintyTable> MakeClosedFormTable(const Campaign& campaign) {
  VariableGrid grid(
      campaign,
      {Quantity::kRefractionAlongWind, Quantity::kRefractionCrossWind, Quantity::kThu, Quantity::kTvu},
      false);
  tbb::parallel_for(std::size_t{0}, EncounterCount(campaign), [&](std::size_t i) {
    const Encounter encounter = EncounterOf(campaign, i);
    const SeaState sea(encounter.sea);
    for (std::size_t beam = 0; beam < encounter.beams.size(); ++beam) {
      const SmallSlopeUncertainty closed = ClosedForm(sea, encounter.beams[beam], encounter.refractive_index);
      grid.Set(Quantity::kRefractionAlongWind, i, beam, 0, InDegrees({closed.refraction_along_wind, 0}));
      grid.Set(Quantity::kRefractionCrossWind, i, beam, 0, InDegrees({closed.refraction_cross_wind, 0}));
      for (std::size_t d = 0; d < encounter.depths.size(); ++d) {
        grid.Set(Quantity::kThu, i, beam, d, {encounter.depths[d] * closed.thu_per_depth, 0});
        grid.Set(Quantity::kTvu, i, beam, d, {encounter.depths[d] * closed.tvu_per_depth, 0});
      }
    }
  });
  Provenance provenance;
  provenance.id = campaign.id + "-closed-form";
  provenance.version = campaign.version;
  provenance.title = "Small-slope theory on the axes of: " + campaign.title;
  return UncertaintyTable::Create(campaign.axes, grid.Take(), std::move(provenance));
}

absl::StatusOr<InterpolationError> MeasureInterpolationError(const Campaign& campaign) {
  constexpr int kPulses = 400;
  const absl::StatusOr<UncertaintyTable> table = MakeClosedFormTable(campaign);
  if (!table.ok()) return table.status();
  std::vector<double> draws(kPulses * kAxisCount);
  NormalStream(campaign.seed, 0, 0).Fill(draws);
  for (double& draw : draws) draw = 0.5 * std::erfc(-draw / std::sqrt(2.0));  // normal to uniform

  InterpolationError error{std::vector<double>(kPulses), std::vector<double>(kPulses)};
  tbb::parallel_for(0, kPulses, [&](int i) {
    const auto coordinate = [&](AxisId axis) {
      return AlongAxis(table->axis(axis), draws[i * kAxisCount + Index(axis)]);
    };
    const Pulse pulse{.wind_speed = coordinate(AxisId::kWindSpeed),
                      .fetch = coordinate(AxisId::kFetch),
                      .incidence = coordinate(AxisId::kIncidence),
                      .azimuth = coordinate(AxisId::kAzimuth),
                      .footprint = coordinate(AxisId::kFootprint),
                      .depth = std::max(coordinate(AxisId::kDepth), 1e-3f)};
    const PulseUncertainty interpolated = Interpolate(*table, pulse);
    const SmallSlopeUncertainty exact = ClosedFormOf(campaign, pulse);
    error.refraction_along_wind[i] = std::abs(
        interpolated[Quantity::kRefractionAlongWind] / DegreesOfRadians(exact.refraction_along_wind) - 1);
    error.thu[i] = std::abs(interpolated[Quantity::kThu] / (pulse.depth * exact.thu_per_depth) - 1);
  });
  std::sort(error.refraction_along_wind.begin(), error.refraction_along_wind.end());
  std::sort(error.thu.begin(), error.thu.end());
  return error;
}

}  // namespace albtpu
