#include "budget/water/water_columns.h"

#include <cmath>
#include <limits>

#include "sea/angle.h"

namespace albtpu {
namespace {

float At(std::span<const float> column, std::size_t i) { return column[column.size() == 1 ? 0 : i]; }

double IncidenceOf(const WaterPulses& pulses, std::size_t i) { return RadiansOfDegrees(At(pulses.incidence, i)); }

// That of scattering between surface and bottom.
void AddColumn(const CompiledWater& water, double index, const WaterPulses& pulses, WaterBatch& batch) {
  const WaterContribution& share = *water.share;
  share.Compute(pulses.incidence, pulses.depth,
                {.bias_along = batch.bias_along,
                 .bias_vertical = batch.bias_vertical,
                 .sigma_along = batch.sigma_along,
                 .sigma_vertical = batch.sigma_vertical,
                 .correlation = batch.correlation,
                 .stretch = batch.stretch});
  for (std::size_t i = 0; i < pulses.size; ++i) {
    const bool cut = !pulses.footprint.empty() && At(pulses.footprint, i) > share.greatest_footprint();
    if (cut || !std::isfinite(batch.sigma_vertical[i])) {
      batch.sigma_vertical[i] = std::numeric_limits<float>::quiet_NaN();
      batch.bias_along[i] = batch.bias_vertical[i] = 0;
    } else if (water.photons.has_value()) {
      const double sine = std::sin(IncidenceOf(pulses, i)) / index;
      batch.noise[i] =
          static_cast<float>(share.PhotonNoise(*water.photons, batch.stretch[i], std::sqrt(1 - sine * sine)));
    }
  }
}

void AddBias(double along, double vertical, std::size_t i, WaterBatch& batch) {
  batch.bias_along[i] = static_cast<float>(batch.bias_along[i] + along);
  batch.bias_vertical[i] = static_cast<float>(batch.bias_vertical[i] + vertical);
}

// That of ranges which were computed with another index.
void AddIndex(const CompiledWater& water, const WaterPulses& pulses, WaterBatch& batch) {
  for (std::size_t i = 0; i < pulses.size; ++i) {
    const IndexBias bias = BiasOfIndex(IncidenceOf(pulses, i), *water.of_water, water.processed_with);
    const float z = At(pulses.depth, i);
    AddBias(bias.along * z, bias.vertical * z, i, batch);
  }
}

// The mean is a bias; its uncertainty is common to all pulses, and moves points on one line.
void AddGreenSurface(const GreenSurface& surface, double index, const WaterPulses& pulses, WaterBatch& batch) {
  for (std::size_t i = 0; i < pulses.size; ++i) {
    if (batch.is_beyond(i)) continue;
    const ShiftBySurface shift = ShiftBySurfaceOf(IncidenceOf(pulses, i), index);
    AddBias(shift.along * surface.mean, -shift.down * surface.mean, i, batch);
    const double along = batch.sigma_along[i], up = batch.sigma_vertical[i];
    const double more_along = shift.along * surface.unknown, more_down = shift.down * surface.unknown;
    const double both = batch.correlation[i] * along * up - more_along * more_down;
    const double all_along = std::hypot(along, more_along), all_up = std::hypot(up, more_down);
    batch.sigma_along[i] = static_cast<float>(all_along);
    batch.sigma_vertical[i] = static_cast<float>(all_up);
    batch.correlation[i] = all_along > 0 && all_up > 0 ? static_cast<float>(both / (all_along * all_up)) : 0;
  }
}

}  // namespace

bool WaterBatch::is_beyond(std::size_t i) const { return !sigma_vertical.empty() && std::isnan(sigma_vertical[i]); }

void ComputeWater(const CompiledWater& water, double index, const WaterPulses& pulses, WaterBatch& batch) {
  for (std::vector<float>* column :
       {&batch.sigma_along, &batch.sigma_vertical, &batch.correlation, &batch.noise, &batch.stretch})
    column->assign(water.has_share() ? pulses.size : 0, 0.0f);
  for (std::vector<float>* column : {&batch.bias_along, &batch.bias_vertical})
    column->assign(water.has_share() || water.of_water.has_value() ? pulses.size : 0, 0.0f);
  if (pulses.size == 0) return;
  if (water.share != nullptr) AddColumn(water, index, pulses, batch);
  if (water.of_water.has_value()) AddIndex(water, pulses, batch);
  if (water.surface.has_value()) AddGreenSurface(*water.surface, index, pulses, batch);
}

}  // namespace albtpu
