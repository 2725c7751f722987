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

TotalInputs::TotalInputs(const TotalPlan& plan, const PulseBatch& pulses, const AnswerBatch& sea,
                         const WaterBatch& water, AircraftColumns& aircraft)
    : sea_axis_(plan.sea_axis.value_or(NAN)),
      wave_height_(plan.wave_height),
      directed_(!aircraft.beam_azimuth.empty()) {
  const AirErrors& errors = plan.options.errors;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto fill = [&](bool by_pulse, BudgetInput first, double assumed) {
      std::vector<float>& column = aircraft[static_cast<BudgetInput>(static_cast<std::size_t>(first) + axis)];
      if (!by_pulse) return column.clear();
      sigmas_assumed_ = std::max<std::uint64_t>(sigmas_assumed_, FillSigma(assumed, column));
    };
    fill(plan.position_by_pulse, BudgetInput::kPositionSigmaNorth, errors.position[axis]);
    fill(plan.attitude_by_pulse, BudgetInput::kRollSigma, errors.attitude[axis]);
  }

  // Where no direction is known, lengths are right, and horizontal covariances are not stated.
  static constexpr float kNorth = 0;
  columns_.size = pulses.size;
  columns_[BudgetInput::kIncidence] = pulses.axis[Index(AxisId::kIncidence)];
  columns_[BudgetInput::kDepth] = pulses.axis[Index(AxisId::kDepth)];
  columns_[BudgetInput::kAltitude] = aircraft.altitude;
  columns_[BudgetInput::kBeamAzimuth] =
      directed_ ? std::span<const float>(aircraft.beam_azimuth) : std::span<const float>(&kNorth, 1);
  for (std::size_t i = 0; i < AircraftColumns::kMotions; ++i)
    columns_.columns[static_cast<std::size_t>(BudgetInput::kRoll) + i] = aircraft.motion[i];
  const auto answer = [&](Quantity quantity) -> std::span<const float> {
    return sea.values[Index(quantity)];
  };
  columns_[BudgetInput::kSeaThu] = answer(Quantity::kThu);
  columns_[BudgetInput::kSeaTvu] = answer(Quantity::kTvu);
  columns_[BudgetInput::kRefractionAlong] = answer(Quantity::kRefractionAlongWind);
  columns_[BudgetInput::kRefractionCross] = answer(Quantity::kRefractionCrossWind);
  // A table without biases does not know them.
  const auto known = [&](Quantity quantity, std::vector<float>& column) {
    const std::span<const float> biases = answer(quantity);
    column.assign(biases.begin(), biases.end());
    for (float& bias : column) bias = std::isfinite(bias) ? bias : 0;
    return std::span<const float>(column);
  };
  columns_[BudgetInput::kBiasAlongBeam] = known(Quantity::kBiasAlongBeam, bias_along_);
  columns_[BudgetInput::kBiasVertical] = known(Quantity::kBiasVertical, bias_vertical_);
  columns_[BudgetInput::kWaterSigmaAlong] = water.sigma_along;
  columns_[BudgetInput::kWaterSigmaVertical] = water.sigma_vertical;
  columns_[BudgetInput::kWaterCorrelation] = water.correlation;
  columns_[BudgetInput::kWaterNoise] = water.noise;
  if (directed_) {
    columns_[BudgetInput::kSeaAxis] =
        sea.sea_axes.empty() ? std::span<const float>(&sea_axis_, 1) : std::span<const float>(sea.sea_axes);
  }
  if (plan.waves_unseen()) {
    columns_[BudgetInput::kWaveHeight] = sea.wave_heights.empty() ? std::span<const float>(&wave_height_, 1)
                                                                  : std::span<const float>(sea.wave_heights);
  }
}

void ComputeTotals(const TotalPlan& plan, const PulseBatch& pulses, const AnswerBatch& sea,
                   AircraftColumns& aircraft, TotalBatch& totals) {
  const std::size_t size = pulses.size;
  const TotalInputs inputs(plan, pulses, sea, totals.water, aircraft);
  totals.sigmas_assumed = inputs.sigmas_assumed();
  BudgetOutputs outputs;
  const auto column = [&](std::vector<float>& numbers) {
    numbers.resize(size);
    return std::span<float>(numbers);
  };
  const auto variances = [&](TotalBatch::Variances& of, CovarianceColumns& columns) {
    columns[0] = column(of.north);
    columns[1] = column(of.east);
    columns[2] = column(of.down);
  };
  outputs.thu = column(totals.thu);
  outputs.tvu = column(totals.tvu);
  outputs.thu_air = column(totals.thu_air);
  outputs.tvu_air = column(totals.tvu_air);
  outputs.thu_sea = column(totals.thu_sea);
  outputs.tvu_sea = column(totals.tvu_sea);
  if (!totals.water.noise.empty()) {
    outputs.thu_water = column(totals.thu_water);
    outputs.tvu_water = column(totals.tvu_water);
    variances(totals.of_water, outputs.water);
  }
  for (std::size_t i = 0; i < totals.covariance.size(); ++i) outputs.total[i] = column(totals.covariance[i]);
  variances(totals.air, outputs.air);
  variances(totals.sea, outputs.sea);
  for (std::size_t g = 0; g < kErrorGroups; ++g) variances(totals.groups[g], outputs.groups[g]);
  totals.best_orders.resize(size);
  outputs.best_orders = totals.best_orders;
  ComputeBudget(inputs.columns(), plan.options, outputs);
  if (inputs.directed()) return;
  for (const std::size_t entry : {0, 1, 3, 4, 5}) totals.covariance[entry].assign(size, NAN);
}

std::array<float, 6> OnGridAxes(const std::array<std::vector<float>, 6>& covariance, std::size_t i,
                                float convergence) {
  // The x axis is (north, east) = (-s, c), the y axis (c, s).
  const float c = std::cos(convergence), s = std::sin(convergence);
  const float nn = covariance[0][i], ee = covariance[1][i], dd = covariance[2][i];
  const float ne = covariance[3][i], nd = covariance[4][i], ed = covariance[5][i];
  return {s * s * nn + c * c * ee - 2 * s * c * ne,
          c * c * nn + s * s * ee + 2 * s * c * ne,
          dd,
          s * c * (ee - nn) + (c * c - s * s) * ne,
          s * nd - c * ed,
          -(c * nd + s * ed)};
}

}  // namespace albtpu::client
