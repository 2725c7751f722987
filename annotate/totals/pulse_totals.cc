#include "annotate/totals/pulse_totals.h"

#include <algorithm>
#include <cmath>

namespace albtpu::annotate {
namespace {

// The sigmas of the plan in place of those of the trajectory that are not known, or not wanted. Returns at how many
// pulses they were not known.
std::uint64_t TakeSigmas(const TotalPlan& plan, AircraftColumns& aircraft) {
  std::uint64_t assumed = 0;
  const auto fill = [&](bool by_pulse, BudgetInput input, double of_plan) {
    std::vector<float>& column = aircraft[input];
    if (!by_pulse) return column.clear();
    const auto is_unknown = [](float sigma) { return !std::isfinite(sigma); };
    assumed = std::max<std::uint64_t>(assumed, std::ranges::count_if(column, is_unknown));
    std::ranges::replace_if(column, is_unknown, static_cast<float>(of_plan));
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    fill(plan.position_by_pulse, BudgetInput::kPositionSigmaNorth + axis, plan.options.errors.position[axis]);
    fill(plan.attitude_by_pulse, BudgetInput::kRollSigma + axis, plan.options.errors.attitude[axis]);
  }
  return assumed;
}

template <typename Number>
std::span<Number> Column(std::size_t size, std::vector<Number>& numbers) {
  numbers.resize(size);
  return numbers;
}

CovarianceColumns Covariances(std::size_t size, bool whole, TotalBatch::Covariance& of) {
  CovarianceColumns columns;
  for (std::size_t i = 0; i < (whole ? 6 : 3); ++i) columns[i] = Column(size, of[i]);
  return columns;
}

// What every total has.
BudgetOutputs OutputsIn(std::size_t size, TotalBatch& totals) {
  BudgetOutputs outputs;
  outputs.thu = Column(size, totals.thu);
  outputs.tvu = Column(size, totals.tvu);
  outputs.thu_air = Column(size, totals.thu_air);
  outputs.tvu_air = Column(size, totals.tvu_air);
  outputs.total = Covariances(size, true, totals.covariance);
  outputs.air = Covariances(size, totals.whole, totals.air);
  for (std::size_t g = 0; g < kErrorGroups; ++g) outputs.groups[g] = Covariances(size, totals.whole, totals.groups[g]);
  return outputs;
}

void TakeExtra(const BudgetOptions& options, TotalBatch& totals) {
  totals.extra = ExtraOf(options);
  totals.extra_horizontal_variance = static_cast<float>(options.extra_horizontal * options.extra_horizontal);
  totals.extra_vertical_variance = static_cast<float>(options.extra_vertical * options.extra_vertical);
}

// Where the beam travelled to is not known.
void ForgetDirections(TotalBatch& totals) {
  for (const std::size_t entry : {0, 1, 3, 4, 5}) totals.covariance[entry].assign(totals.size(), NAN);
}

}  // namespace

void SelectForTotals(AnswerSelection& selection) {
  selection.quantities.fill(true);
  selection.sea_frame = true;
}

void ComputeTotals(const TotalPlan& plan, const PulseBatch& pulses, const AnswerBatch& sea, AircraftColumns& aircraft,
                   TotalBatch& totals) {
  totals.sigmas_assumed = TakeSigmas(plan, aircraft);
  TakeExtra(plan.options, totals);
  BudgetPulses asked{.pulses = pulses.columns(), .aircraft = {.size = pulses.size}, .sea_axis = {}};
  for (const BudgetInput input : kAircraftInputs) asked.aircraft[input] = aircraft[input];
  asked.aircraft[BudgetInput::kWaterSigmaAlong] = totals.water.sigma_along;
  asked.aircraft[BudgetInput::kWaterSigmaVertical] = totals.water.sigma_vertical;
  asked.aircraft[BudgetInput::kWaterCorrelation] = totals.water.correlation;
  asked.aircraft[BudgetInput::kWaterNoise] = totals.water.noise;
  asked.aircraft[BudgetInput::kSeaAxis] = sea.sea_axes;
  if (sea.sea_axes.empty()) asked.sea_axis = plan.sea_axis;
  if (plan.waves_unseen()) {
    asked.aircraft[BudgetInput::kWaveHeight] =
        sea.wave_heights.empty() ? std::span(&plan.wave_height, 1) : std::span(sea.wave_heights);
  }
  SeaContribution share;
  for (std::size_t i = 0; i < share.size(); ++i) share[i] = sea.values[i];

  BudgetOutputs outputs = OutputsIn(pulses.size, totals);
  outputs.thu_sea = Column(pulses.size, totals.thu_sea);
  outputs.tvu_sea = Column(pulses.size, totals.tvu_sea);
  if (!totals.water.noise.empty()) {
    outputs.thu_water = Column(pulses.size, totals.thu_water);
    outputs.tvu_water = Column(pulses.size, totals.tvu_water);
    outputs.water = Covariances(pulses.size, totals.whole, totals.of_water);
  }
  outputs.sea = Covariances(pulses.size, totals.whole, totals.sea);
  outputs.best_orders = Column(pulses.size, totals.best_orders);
  ComputePulseBudget(asked, share, plan.options, outputs);
  if (aircraft[BudgetInput::kBeamAzimuth].empty()) ForgetDirections(totals);
}

void ComputeDryTotals(const TotalPlan& plan, std::span<const float> incidence, AircraftColumns& aircraft,
                      TotalBatch& totals) {
  totals.sigmas_assumed = TakeSigmas(plan, aircraft);
  TakeExtra(plan.options, totals);
  BudgetOptions options = plan.options;
  options.located = SurfaceLocation::kPulse;
  options.index = 1;
  options.errors.bottom_range = plan.hard_range;
  options.errors.surface_range = options.errors.surface_height = options.errors.index = 0;
  BudgetInputs inputs{.size = incidence.size()};
  for (const BudgetInput input : kAircraftInputs) inputs[input] = aircraft[input];
  inputs[BudgetInput::kIncidence] = incidence;
  ComputeBudget(inputs, options, OutputsIn(inputs.size, totals));
  if (aircraft[BudgetInput::kBeamAzimuth].empty()) ForgetDirections(totals);
}

std::array<float, 6> OnGridAxes(const TotalBatch::Covariance& covariance, std::size_t i, float convergence) {
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

}  // namespace albtpu::annotate
