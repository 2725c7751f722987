#include "budget/query/budget_query.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <thread>

#include "budget/total/reported_point.h"

namespace albtpu {
namespace {

constexpr std::size_t kGrain = 8192;  // Pulses in a piece of work, which takes at least 300 us.
constexpr auto kInterpolated = static_cast<std::uint8_t>(static_cast<int>(Outcome::kInterpolated) + 1);
constexpr auto kInvalid = static_cast<std::uint8_t>(static_cast<int>(Outcome::kInvalid) + 1);

// Memory of one piece of work.
struct Scratch {
  std::uint8_t outcomes[kGrain], outcome_axes[kGrain], invalid[kGrain];
  float sea_thu[kGrain], sea_tvu[kGrain], along[kGrain], cross[kGrain];
  float bias_along_beam[kGrain], bias_vertical[kGrain];
};

bool IsSigma(BudgetInput input) {
  return input == BudgetInput::kWaveHeight || input == BudgetInput::kWaterSigmaAlong ||
         input == BudgetInput::kWaterSigmaVertical || input == BudgetInput::kWaterNoise ||
         (input >= BudgetInput::kPositionSigmaNorth && input <= BudgetInput::kHeadingSigma);
}

// The numbers that a column of the aircraft may have are above this one, up to kGreatestBudgetNumber.
float Below(BudgetInput input) {
  if (input == BudgetInput::kAltitude) return 0;
  const float least = IsSigma(input) ? 0 : -static_cast<float>(kGreatestBudgetNumber);
  return std::nextafter(least, -std::numeric_limits<float>::infinity());
}

}  // namespace

void FindInvalid(const BudgetInputs& aircraft, std::uint8_t* invalid) {
  std::fill_n(invalid, aircraft.size, std::uint8_t{0});
  for (const BudgetInput input : kAircraftInputs) {
    const std::span<const float> column = aircraft[input];
    if (column.empty()) continue;
    const float below = Below(input);
    const auto greatest = static_cast<float>(kGreatestBudgetNumber);
    const auto is_invalid = [=](float x) {
      return static_cast<std::uint8_t>((static_cast<int>(x > below) & static_cast<int>(x <= greatest)) ^ 1);
    };
    if (column.size() == 1) {
      if (is_invalid(column[0])) std::fill_n(invalid, aircraft.size, std::uint8_t{1});
      continue;
    }
    for (std::size_t i = 0; i < aircraft.size; ++i) invalid[i] |= is_invalid(column[i]);
  }
}

namespace {

BudgetOutputs OutputsAt(const BudgetAnswers& answers, std::size_t begin, std::size_t count) {
  const auto column = [&](std::size_t index) {
    float* const start = answers.columns[index];
    return start == nullptr ? std::span<float>() : std::span(start + begin, count);
  };
  const auto number = [&](BudgetQuantity quantity) { return column(FirstColumn(quantity)); };
  const auto covariance = [&](BudgetQuantity quantity) {
    CovarianceColumns entries;
    for (std::size_t i = 0; i < entries.size(); ++i) entries[i] = column(FirstColumn(quantity) + i);
    return entries;
  };
  using enum BudgetQuantity;
  BudgetOutputs outputs{
      .thu = number(kTotalThu),
      .tvu = number(kTotalTvu),
      .thu_air = number(kThuAir),
      .tvu_air = number(kTvuAir),
      .thu_sea = number(kThuSea),
      .tvu_sea = number(kTvuSea),
      .thu_water = number(kThuWater),
      .tvu_water = number(kTvuWater),
      .air = covariance(kCovarianceAir),
      .sea = covariance(kCovarianceSea),
      .total = covariance(kCovarianceTotal),
      .groups = {covariance(kCovariancePulse), covariance(kCovarianceLine), covariance(kCovarianceSurvey)}};
  if (answers.best_s44_orders != nullptr) outputs.best_orders = {answers.best_s44_orders + begin, count};
  return outputs;
}

// The biases of the sea and of the water, which may be a constant or absent, into the rows from `begin` on.
void Sum(const float* sea, std::span<const float> water, std::size_t begin, std::size_t count, float* column) {
  if (column == nullptr) return;
  for (std::size_t i = 0; i < count; ++i)
    column[begin + i] = water.empty() ? sea[i] : BiasInWater(sea[i], water[water.size() == 1 ? 0 : i]);
}

// From the biases of the table to those of the reported point.
void TakeReportedPoint(std::span<const float> incidence, std::size_t count, double index, Scratch& scratch) {
  for (std::size_t i = 0; i < count; ++i) {
    scratch.bias_along_beam[i] = ReportedBiasAlong(scratch.bias_along_beam[i], scratch.bias_vertical[i],
                                                   incidence[incidence.size() == 1 ? 0 : i], index);
  }
}

// Answers up to kGrain pulses from `begin` on.
void AnswerPiece(const ColumnInterpolator& interpolator, const BudgetPulses& all, const BudgetOptions& options,
                 std::size_t begin, std::size_t count, const BudgetAnswers& answers, Scratch& scratch) {
  BudgetPulses piece = Slice(all, begin, count);
  std::uint8_t* const outcomes = answers.outcomes != nullptr ? answers.outcomes + begin : scratch.outcomes;
  std::uint8_t* const axes = answers.outcome_axes != nullptr ? answers.outcome_axes + begin : scratch.outcome_axes;
  float* const bias_along_beam = answers.columns[FirstColumn(BudgetQuantity::kBiasAlongBeam)];
  float* const bias_vertical = answers.columns[FirstColumn(BudgetQuantity::kBiasVertical)];
  const bool asks_order = answers.best_s44_orders != nullptr;

  AnswerColumns sea{.outcomes = outcomes, .outcome_axes = axes};
  sea.values[Index(Quantity::kThu)] = scratch.sea_thu;
  sea.values[Index(Quantity::kTvu)] = scratch.sea_tvu;
  sea.values[Index(Quantity::kRefractionAlongWind)] = scratch.along;
  sea.values[Index(Quantity::kRefractionCrossWind)] = scratch.cross;
  const bool asks_along = asks_order || bias_along_beam != nullptr;
  if (asks_along) sea.values[Index(Quantity::kBiasAlongBeam)] = scratch.bias_along_beam;
  if (asks_along || bias_vertical != nullptr) sea.values[Index(Quantity::kBiasVertical)] = scratch.bias_vertical;
  interpolator.Interpolate({.coverage = Coverage::kTwoSigma, .s44_order = {}}, piece.pulses, 0, count, sea);
  if (asks_along) TakeReportedPoint(piece.pulses[AxisId::kIncidence], count, options.index, scratch);
  Sum(scratch.bias_along_beam, piece.aircraft[BudgetInput::kWaterBiasAlong], begin, count, bias_along_beam);
  Sum(scratch.bias_vertical, piece.aircraft[BudgetInput::kWaterBiasVertical], begin, count, bias_vertical);

  FindInvalid(piece.aircraft, scratch.invalid);
  for (std::size_t i = 0; i < count; ++i) {
    if (scratch.invalid[i] == 0 || outcomes[i] != kInterpolated) continue;
    outcomes[i] = kInvalid;
    axes[i] = 0;
  }

  SeaContribution contribution;
  for (std::size_t i = 0; i < kQuantityCount; ++i)
    if (sea.values[i] != nullptr) contribution[i] = {sea.values[i], count};
  ComputePulseBudget(piece, contribution, options, OutputsAt(answers, begin, count));

  for (std::size_t i = 0; i < count; ++i) {
    if (outcomes[i] == kInterpolated) continue;
    for (float* const column : answers.columns)
      if (column != nullptr) column[begin + i] = std::numeric_limits<float>::quiet_NaN();
    if (asks_order) answers.best_s44_orders[begin + i] = 0;
  }
}

}  // namespace

void ComputePulseBudget(const BudgetPulses& pulses, const SeaContribution& sea, const BudgetOptions& options,
                        const BudgetOutputs& outputs) {
  BudgetInputs inputs = pulses.aircraft;
  const auto sea_axis = static_cast<float>(pulses.sea_axis.value_or(0));
  if (pulses.sea_axis.has_value()) inputs[BudgetInput::kSeaAxis] = {&sea_axis, 1};
  inputs[BudgetInput::kIncidence] = pulses.pulses[AxisId::kIncidence];
  inputs[BudgetInput::kDepth] = pulses.pulses[AxisId::kDepth];
  inputs[BudgetInput::kSeaThu] = sea[Index(Quantity::kThu)];
  inputs[BudgetInput::kSeaTvu] = sea[Index(Quantity::kTvu)];
  inputs[BudgetInput::kRefractionAlong] = sea[Index(Quantity::kRefractionAlongWind)];
  inputs[BudgetInput::kRefractionCross] = sea[Index(Quantity::kRefractionCrossWind)];
  inputs[BudgetInput::kBiasAlongBeam] = sea[Index(Quantity::kBiasAlongBeam)];
  inputs[BudgetInput::kBiasVertical] = sea[Index(Quantity::kBiasVertical)];
  // Where no direction is known, the error of the sea is taken as the same in all directions.
  if (inputs[BudgetInput::kBeamAzimuth].empty()) inputs[BudgetInput::kSeaAxis] = {};
  ComputeBudget(inputs, options, outputs);
}

BudgetPulses Slice(const BudgetPulses& pulses, std::size_t begin, std::size_t count) {
  BudgetPulses slice{Slice(pulses.pulses, begin, count), pulses.aircraft, pulses.sea_axis};
  slice.aircraft.size = count;
  for (std::span<const float>& column : slice.aircraft.columns)
    if (column.size() > 1) column = column.subspan(begin, count);
  return slice;
}

void QueryBudgetOnAllCores(const ColumnInterpolator& interpolator, const BudgetPulses& pulses,
                           const BudgetOptions& options, const BudgetAnswers& answers) {
  const std::size_t size = pulses.pulses.size;
  const auto answer = [&](std::size_t first, std::size_t last) {
    const auto scratch = std::make_unique_for_overwrite<Scratch>();
    for (std::size_t begin = first; begin < last; begin += kGrain)
      AnswerPiece(interpolator, pulses, options, begin, std::min(kGrain, last - begin), answers, *scratch);
  };
  if (size < 2 * kGrain) return answer(0, size);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size, kGrain), [&](const auto& range) {
    answer(range.begin(), range.end());
    // A query for a single pulse waits for one piece of work, not for a time slice of the system.
    std::this_thread::yield();
  });
}

}  // namespace albtpu
