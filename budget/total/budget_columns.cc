#include "budget/total/budget_columns.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "budget/total/error_ellipse.h"
#include "budget/total/reported_point.h"

// The code below is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "budget/total/budget_columns.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "budget/air/air_covariance-inl.h"
#include "budget/total/sea_covariance-inl.h"

#ifndef ALBTPU_BUDGET_TOTAL_BLOCK
#define ALBTPU_BUDGET_TOTAL_BLOCK
namespace albtpu {
namespace {

// Small enough for all columns of a block to stay in the first-level cache.
constexpr std::size_t kBlock = 64;
using Column = float[kBlock];

// m^2, of all points alike: along north and along east, and along down.
struct CommonVariances {
  float horizontal, vertical;
};

struct alignas(64) CovarianceBlock {
  Column nn, ee, dd, ne, nd, ed;
};

struct alignas(64) Block {
  Column input[kBudgetInputCount];
  CovarianceBlock pulse, line, survey, air, sea, water, total;
};

}  // namespace
}  // namespace albtpu
#endif

HWY_BEFORE_NAMESPACE();
namespace albtpu {
namespace HWY_NAMESPACE {
namespace {

HWY_INLINE void Store(const NedCovariance& c, CovarianceBlock& block, std::size_t i) {
  const Floats d;
  hn::Store(c.nn, d, block.nn + i);
  hn::Store(c.ee, d, block.ee + i);
  hn::Store(c.dd, d, block.dd + i);
  hn::Store(c.ne, d, block.ne + i);
  hn::Store(c.nd, d, block.nd + i);
  hn::Store(c.ed, d, block.ed + i);
}

// The error of the water column that is common to all pulses of a survey. A positive vertical error is too shallow.
HWY_INLINE NedCovariance WaterContributionOf(F along, F vertical, F correlation, const BeamNumbers& beam) {
  const F held = hn::Max(Constant(-1), hn::Min(correlation, Constant(1)));
  const F along2 = along * along, up = held * (along * vertical);
  return {along2 * (beam.north * beam.north), along2 * (beam.east * beam.east), vertical * vertical,
          along2 * (beam.north * beam.east),  hn::Neg(up * beam.north),         hn::Neg(up * beam.east)};
}

// A range in water whose vertical part is 1 m too short.
HWY_INLINE Ned ShortRange(const BeamNumbers& beam) {
  const F back = hn::Neg(beam.sine_refracted / beam.cosine_refracted);
  return {back * beam.north, back * beam.east, Constant(-1)};
}

void ComputeBlock(const AirConstants& is, CommonVariances common, Block& block) {
  const Floats d;
  for (std::size_t i = 0; i < kBlock; i += hn::Lanes(d)) {
    const auto in = [&](BudgetInput input)
                        HWY_ATTR { return hn::Load(d, block.input[static_cast<std::size_t>(input)] + i); };
    const AirContribution air = AirContributionOf(
        {.incidence = in(BudgetInput::kIncidence),
         .beam_azimuth = in(BudgetInput::kBeamAzimuth),
         .altitude = in(BudgetInput::kAltitude),
         .depth = in(BudgetInput::kDepth),
         .roll = in(BudgetInput::kRoll),
         .pitch = in(BudgetInput::kPitch),
         .heading = in(BudgetInput::kHeading),
         .velocity = {in(BudgetInput::kVelocityNorth), in(BudgetInput::kVelocityEast), in(BudgetInput::kVelocityDown)},
         .roll_rate = in(BudgetInput::kRollRate),
         .pitch_rate = in(BudgetInput::kPitchRate),
         .yaw_rate = in(BudgetInput::kYawRate),
         .position_sigma = {in(BudgetInput::kPositionSigmaNorth), in(BudgetInput::kPositionSigmaEast),
                            in(BudgetInput::kPositionSigmaDown)},
         .roll_sigma = in(BudgetInput::kRollSigma),
         .pitch_sigma = in(BudgetInput::kPitchSigma),
         .heading_sigma = in(BudgetInput::kHeadingSigma)},
        is);
    NedCovariance sea = SeaContributionOf({.thu = in(BudgetInput::kSeaThu),
                                           .tvu = in(BudgetInput::kSeaTvu),
                                           .along = in(BudgetInput::kRefractionAlong),
                                           .cross = in(BudgetInput::kRefractionCross),
                                           .axis = in(BudgetInput::kSeaAxis),
                                           .depth = in(BudgetInput::kDepth)},
                                          air.beam);
    sea.Add(in(BudgetInput::kWaveHeight)*air.beam.surface);
    NedCovariance survey = air.survey;
    survey.nn = survey.nn + Constant(common.horizontal);
    survey.ee = survey.ee + Constant(common.horizontal);
    survey.dd = survey.dd + Constant(common.vertical);
    const NedCovariance water =
        WaterContributionOf(in(BudgetInput::kWaterSigmaAlong), in(BudgetInput::kWaterSigmaVertical),
                            in(BudgetInput::kWaterCorrelation), air.beam);
    NedCovariance noise = NoCovariance();
    noise.Add(in(BudgetInput::kWaterNoise)*ShortRange(air.beam));
    survey = survey + water;
    const NedCovariance own = air.pulse + sea + noise;
    Store(own, block.pulse, i);
    Store(air.line, block.line, i);
    Store(survey, block.survey, i);
    Store(air.pulse + air.line + air.survey, block.air, i);
    Store(sea, block.sea, i);
    Store(water + noise, block.water, i);
    Store(own + air.line + survey, block.total, i);
  }
}

// The ratio of the axes of the ellipse of a horizontal covariance, the smaller over the larger: 0 to 1.
void AxisRatios(const CovarianceBlock& c, Column& ratios) {
  const Floats d;
  for (std::size_t i = 0; i < kBlock; i += hn::Lanes(d)) {
    const F nn = hn::Load(d, c.nn + i), ee = hn::Load(d, c.ee + i), ne = hn::Load(d, c.ne + i);
    const F sum = nn + ee, difference = nn - ee;
    const F split = hn::Sqrt(difference * difference + Constant(4) * (ne * ne));
    const F ratio = (sum - split) / (sum + split);
    const F positive = hn::IfThenElseZero(ratio > hn::Zero(d), ratio);  // Also of 0 / 0.
    hn::Store(hn::Sqrt(hn::Min(positive, Constant(1))), d, ratios + i);
  }
}

void Roots(const CovarianceBlock& c, float factor, Column& thu, Column& tvu) {
  const Floats d;
  for (std::size_t i = 0; i < kBlock; i += hn::Lanes(d)) {
    const F horizontal = hn::Load(d, c.nn + i) + hn::Load(d, c.ee + i);
    hn::Store(Constant(factor) * hn::Sqrt(horizontal), d, thu + i);
    hn::Store(Constant(factor) * hn::Sqrt(hn::Load(d, c.dd + i)), d, tvu + i);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace albtpu
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace albtpu {
namespace {

HWY_EXPORT(ComputeBlock);
HWY_EXPORT(AxisRatios);
HWY_EXPORT(Roots);

// The rows from `begin` on; a constant is repeated.
void Read(std::span<const float> column, float absent, std::size_t begin, std::size_t count, Column& block) {
  if (column.size() <= 1)
    std::fill_n(block, kBlock, column.empty() ? absent : column[0]);
  else
    std::copy_n(column.data() + begin, count, block);
}

void Write(const float* block, std::size_t begin, std::size_t count, std::span<float> column) {
  if (!column.empty()) std::copy_n(block, count, column.data() + begin);
}

void Write(const CovarianceBlock& block, std::size_t begin, std::size_t count, const CovarianceColumns& columns) {
  const float* const entries[] = {block.nn, block.ee, block.dd, block.ne, block.nd, block.ed};
  for (std::size_t i = 0; i < columns.size(); ++i) Write(entries[i], begin, count, columns[i]);
}

void AtP95(const CovarianceBlock& c, Column& thu, Column& tvu) {
  HWY_DYNAMIC_DISPATCH(Roots)(c, 2, thu, tvu);
  alignas(64) Column ratios;
  HWY_DYNAMIC_DISPATCH(AxisRatios)(c, ratios);
  const RadiusFactors& factors = RadiusFactors::Get();
  for (std::size_t i = 0; i < kBlock; ++i) {
    thu[i] *= factors(ratios[i]);
    tvu[i] *= static_cast<float>(kFactor95);
  }
}

void AtCoverage(const CovarianceBlock& c, Coverage coverage, Column& thu, Column& tvu) {
  if (coverage == Coverage::kP95) return AtP95(c, thu, tvu);
  HWY_DYNAMIC_DISPATCH(Roots)(c, coverage == Coverage::kOneSigma ? 1 : 2, thu, tvu);
}

}  // namespace

void ComputeBudget(const BudgetInputs& inputs, const BudgetOptions& options, const BudgetOutputs& outputs) {
  assert(options.index >= 1);
  const AirConstants constants(options.errors, options.located, options.index, options.lever_arm);
  const double horizontal = options.extra_horizontal, vertical = options.extra_vertical;
  const CommonVariances common = {static_cast<float>(horizontal * horizontal / 2),
                                  static_cast<float>(options.datum * options.datum + vertical * vertical)};
  std::array<float, kBudgetInputCount> absent = {};
  const auto set = [&](BudgetInput input, double value) {
    absent[static_cast<std::size_t>(input)] = static_cast<float>(value);
  };
  set(BudgetInput::kPositionSigmaNorth, options.errors.position[0]);
  set(BudgetInput::kPositionSigmaEast, options.errors.position[1]);
  set(BudgetInput::kPositionSigmaDown, options.errors.position[2]);
  set(BudgetInput::kRollSigma, options.errors.attitude[0]);
  set(BudgetInput::kPitchSigma, options.errors.attitude[1]);
  set(BudgetInput::kHeadingSigma, options.errors.attitude[2]);
  set(BudgetInput::kSeaAxis, std::numeric_limits<double>::quiet_NaN());

  Block block = {};  // Rows that the last block does not fill are computed, but not written.
  for (std::size_t begin = 0; begin < inputs.size; begin += kBlock) {
    const std::size_t count = std::min(kBlock, inputs.size - begin);
    for (std::size_t i = 0; i < kBudgetInputCount; ++i) {
      assert(inputs.columns[i].size() <= 1 || inputs.columns[i].size() == inputs.size);
      if (begin == 0 || inputs.columns[i].size() > 1) Read(inputs.columns[i], absent[i], begin, count, block.input[i]);
    }
    HWY_DYNAMIC_DISPATCH(ComputeBlock)(constants, common, block);
    alignas(64) Column thu, tvu;
    const auto state = [&](const CovarianceBlock& c, std::span<float> thu_column, std::span<float> tvu_column) {
      if (thu_column.empty() && tvu_column.empty()) return;
      AtCoverage(c, options.coverage, thu, tvu);
      Write(thu, begin, count, thu_column);
      Write(tvu, begin, count, tvu_column);
    };
    state(block.air, outputs.thu_air, outputs.tvu_air);
    state(block.sea, outputs.thu_sea, outputs.tvu_sea);
    state(block.water, outputs.thu_water, outputs.tvu_water);
    state(block.total, outputs.thu, outputs.tvu);
    Write(block.air, begin, count, outputs.air);
    Write(block.sea, begin, count, outputs.sea);
    Write(block.water, begin, count, outputs.water);
    Write(block.total, begin, count, outputs.total);
    const CovarianceBlock* const groups[] = {&block.pulse, &block.line, &block.survey};
    for (std::size_t g = 0; g < kErrorGroups; ++g) Write(*groups[g], begin, count, outputs.groups[g]);
    if (outputs.best_orders.empty()) continue;
    AtP95(block.total, thu, tvu);
    const auto in = [&](BudgetInput input) { return block.input[static_cast<std::size_t>(input)]; };
    for (std::size_t i = 0; i < count; ++i) {
      outputs.best_orders[begin + i] = BestOrderMet(
          thu[i], tvu[i], BiasInWater(in(BudgetInput::kBiasAlongBeam)[i], in(BudgetInput::kWaterBiasAlong)[i]),
          BiasInWater(in(BudgetInput::kBiasVertical)[i], in(BudgetInput::kWaterBiasVertical)[i]),
          in(BudgetInput::kDepth)[i]);
    }
  }
}

ExtraUncertainty ExtraOf(const BudgetOptions& options) {
  const double vertical = VerticalFactor(options.coverage);
  const double radial = options.coverage == Coverage::kP95 ? 2 * RadiusFactor95(1) : vertical;
  return {static_cast<float>(radial * options.extra_horizontal), static_cast<float>(vertical * options.extra_vertical)};
}

}  // namespace albtpu
#endif  // HWY_ONCE
