#include "survey/totals/pulse_totals.h"

#include <algorithm>
#include <cmath>

namespace albtpu::client {
namespace {

// The sigma of the plan in place of what is not known.
std::size_t FillSigma(double assumed, std::vector<float>& column) {
  std::size_t filled = 0;
  for (float& sigma : column) {
    if (std::isfinite(sigma)) continue;
    sigma = static_cast<float>(assumed);
    ++filled;
  }
  return filled;
}

}  // namespace

void SelectForTotals(AnswerSelection& selection) {
  selection.quantities.fill(true);
  selection.sea_frame = true;
}

void ComputeTotals(const TotalPlan& plan, const PulseBatch& pulses, const AnswerBatch& sea, AircraftColumns& aircraft,
                   TotalBatch& totals) {
  const std::size_t size = pulses.size;
  const AirErrors& errors = plan.options.errors;
  totals.sigmas_assumed = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto fill = [&](bool by_pulse, BudgetInput first, double assumed) {
      std::vector<float>& column = aircraft[static_cast<BudgetInput>(static_cast<std::size_t>(first) + axis)];
      if (!by_pulse) return column.clear();
      totals.sigmas_assumed = std::max<std::uint64_t>(totals.sigmas_assumed, FillSigma(assumed, column));
    };
    fill(plan.position_by_pulse, BudgetInput::kPositionSigmaNorth, errors.position[axis]);
    fill(plan.attitude_by_pulse, BudgetInput::kRollSigma, errors.attitude[axis]);
  }

  BudgetInputs inputs{.size = size};
  const float north = 0;  // Where no direction is known, lengths are right, and horizontal covariances are not stated.
  inputs[BudgetInput::kIncidence] = pulses.axis[Index(AxisId::kIncidence)];
  inputs[BudgetInput::kDepth] = pulses.axis[Index(AxisId::kDepth)];
  inputs[BudgetInput::kAltitude] = aircraft.altitude;
  inputs[BudgetInput::kBeamAzimuth] = aircraft.beam_azimuth;
  const bool directed = !aircraft.beam_azimuth.empty();
  if (!directed) inputs[BudgetInput::kBeamAzimuth] = std::span<const float>(&north, 1);
  for (std::size_t i = 0; i < AircraftColumns::kMotions; ++i)
    inputs.columns[static_cast<std::size_t>(BudgetInput::kRoll) + i] = aircraft.motion[i];
  const auto answer = [&](Quantity quantity) -> std::span<const float> { return sea.values[Index(quantity)]; };
  inputs[BudgetInput::kSeaThu] = answer(Quantity::kThu);
  inputs[BudgetInput::kSeaTvu] = answer(Quantity::kTvu);
  inputs[BudgetInput::kRefractionAlong] = answer(Quantity::kRefractionAlongWind);
  inputs[BudgetInput::kRefractionCross] = answer(Quantity::kRefractionCrossWind);
  // A table without biases does not know them.
  std::vector<float> along(answer(Quantity::kBiasAlongBeam).begin(), answer(Quantity::kBiasAlongBeam).end());
  std::vector<float> vertical(answer(Quantity::kBiasVertical).begin(), answer(Quantity::kBiasVertical).end());
  for (std::vector<float>* column : {&along, &vertical})
    for (float& bias : *column) bias = std::isfinite(bias) ? bias : 0;
  inputs[BudgetInput::kBiasAlongBeam] = along;
  inputs[BudgetInput::kBiasVertical] = vertical;
  if (!sea.sea_axes.empty()) {
    inputs[BudgetInput::kSeaAxis] = sea.sea_axes;
  } else if (plan.sea_axis.has_value()) {
    inputs[BudgetInput::kSeaAxis] = std::span<const float>(&*plan.sea_axis, 1);
  }
  if (!directed) inputs[BudgetInput::kSeaAxis] = {};
  if (plan.waves_unseen()) {
    inputs[BudgetInput::kWaveHeight] =
        sea.wave_heights.empty() ? std::span<const float>(&plan.wave_height, 1) : std::span<const float>(sea.wave_heights);
  }

  BudgetOutputs outputs;
  const auto column = [&](std::vector<float>& numbers) {
    numbers.resize(size);
    return std::span<float>(numbers);
  };
  outputs.thu = column(totals.thu);
  outputs.tvu = column(totals.tvu);
  outputs.thu_air = column(totals.thu_air);
  outputs.tvu_air = column(totals.tvu_air);
  outputs.thu_sea = column(totals.thu_sea);
  outputs.tvu_sea = column(totals.tvu_sea);
  for (std::size_t i = 0; i < totals.covariance.size(); ++i) outputs.total[i] = column(totals.covariance[i]);
  const auto variances = [&](TotalBatch::Variances& of, CovarianceColumns& columns) {
    columns[0] = column(of.north);
    columns[1] = column(of.east);
    columns[2] = column(of.down);
  };
  variances(totals.air, outputs.air);
  variances(totals.sea, outputs.sea);
  for (std::size_t g = 0; g < kErrorGroups; ++g) variances(totals.groups[g], outputs.groups[g]);
  totals.best_orders.resize(size);
  outputs.best_orders = totals.best_orders;
  ComputeBudget(inputs, plan.options, outputs);
  if (directed) return;
  for (const std::size_t entry : {0, 1, 3, 4, 5}) totals.covariance[entry].assign(size, NAN);
}

}  // namespace albtpu::client
