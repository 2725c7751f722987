// The whole budget of many pulses: the contribution of the sea surface from a table, added to those of the air side,
// the water column and the datum.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "budget/total/budget_columns.h"
#include "tables/query/column_query.h"
#include "tables/query/pulse_columns.h"

namespace albtpu {

// The numbers of a budget, in the order of the wire.
enum class BudgetQuantity : std::uint8_t {
  kTotalThu,          // m, at the coverage of the options, of all shares.
  kTotalTvu,          // m
  kThuAir,            // m, of the air side alone.
  kTvuAir,            // m
  kThuSea,            // m, of sea surface and unseen waves.
  kTvuSea,            // m
  kBiasAlongBeam,     // m, of the reported point, that of the water included; in no covariance. NaN if not known.
  kBiasVertical,      // m
  kCovarianceTotal,   // m^2, 1 sigma: six columns in the order of kCovarianceNames.
  kCovarianceAir,     // As BudgetOutputs::air.
  kCovarianceSea,     // As BudgetOutputs::sea.
  kCovariancePulse,   // As BudgetOutputs::groups.
  kCovarianceLine,    // As BudgetOutputs::groups.
  kCovarianceSurvey,  // As BudgetOutputs::groups.
  kBestS44Order,      // BudgetAnswers::best_s44_orders
  kThuWater,          // m, of the water column.
  kTvuWater,          // m
};
inline constexpr std::size_t kBudgetQuantityCount = 17;

// Which columns of single-precision numbers a quantity has: one, the six of a covariance, or none for the best order.
inline constexpr std::size_t kBudgetColumnCount = 8 + 6 * 6 + 2;
constexpr std::size_t ColumnCount(BudgetQuantity quantity) {
  switch (quantity) {
    case BudgetQuantity::kBestS44Order:
      return 0;
    case BudgetQuantity::kCovarianceTotal:
    case BudgetQuantity::kCovarianceAir:
    case BudgetQuantity::kCovarianceSea:
    case BudgetQuantity::kCovariancePulse:
    case BudgetQuantity::kCovarianceLine:
    case BudgetQuantity::kCovarianceSurvey:
      return 6;
    default:
      return 1;
  }
}
constexpr std::size_t FirstColumn(BudgetQuantity quantity) {
  std::size_t first = 0;
  for (std::size_t q = 0; q < static_cast<std::size_t>(quantity); ++q)
    first += ColumnCount(static_cast<BudgetQuantity>(q));
  return first;
}
static_assert(FirstColumn(BudgetQuantity::kTvuWater) + 1 == kBudgetColumnCount);

// Where to write answers: columns of as many elements as there are pulses, or null if an answer is not wanted.
struct BudgetAnswers {
  std::uint8_t* outcomes = nullptr;      // As AnswerColumns; 3 also if a number of the aircraft is not valid.
  std::uint8_t* outcome_axes = nullptr;  // As AnswerColumns; 0 if a number of the aircraft made the outcome.
  std::array<float*, kBudgetColumnCount> columns = {};  // NaN where there is no number.
  std::uint8_t* best_s44_orders = nullptr;              // As BudgetOutputs; a bias of NaN counts as 0.
};

// Pulses whose budget is asked.
struct BudgetPulses {
  PulseColumns pulses;  // As asked of the table.
  // The columns kAircraftInputs at the same pulses, and kSeaAxis where it differs from pulse to pulse.
  BudgetInputs aircraft = {};
  // degree, clockwise from true north: the downwind direction, or the x axis of the table's sea. Absent: not known.
  std::optional<double> sea_axis = {};
};

// The inputs that are the aircraft's and the water's, in the order of the wire. Altitude and beam azimuth are required.
inline constexpr std::array<BudgetInput, 24> kAircraftInputs = [] {
  std::array<BudgetInput, 24> inputs = {BudgetInput::kAltitude, BudgetInput::kBeamAzimuth};
  for (std::size_t i = 0; i < kMotionInputs; ++i) inputs[2 + i] = BudgetInput::kRoll + i;
  for (std::size_t i = 2 + kMotionInputs; i < inputs.size(); ++i)
    inputs[i] = BudgetInput::kWaveHeight + (i - 2 - kMotionInputs);
  return inputs;
}();
static_assert(kAircraftInputs.back() == BudgetInput::kWaterBiasVertical);
constexpr bool IsRequired(BudgetInput input) {
  return input == BudgetInput::kAltitude || input == BudgetInput::kBeamAzimuth;
}

// The share of the sea at each pulse, as a table answers it at 2 sigma: a column for each Quantity, or none where it is
// not known. A bias of NaN is not known; the one along the beam is of the reported point (ReportedBiasAlong).
using SeaContribution = std::array<std::span<const float>, kQuantityCount>;

// Adds all shares. Every total of files, servers and libraries is computed here.
void ComputePulseBudget(const BudgetPulses& pulses, const SeaContribution& sea, const BudgetOptions& options,
                        const BudgetOutputs& outputs);

// The pulses from `begin` on.
BudgetPulses Slice(const BudgetPulses& pulses, std::size_t begin, std::size_t count);

// The largest magnitude of a number of the aircraft and of BudgetOptions, in any unit: far beyond that of any aircraft,
// and sums of products of three such numbers have squares that single precision holds (1e38).
inline constexpr double kGreatestBudgetNumber = 1e6;

// Whether a number of the aircraft of each pulse is not valid, 0 or 1: NaN or beyond kGreatestBudgetNumber, an altitude
// not above 0, a standard deviation or a wave height negative.
void FindInvalid(const BudgetInputs& aircraft, std::uint8_t* invalid);

// Answers all pulses, for which CheckQuery() must be OK. The answer for a pulse depends on this pulse and the
// instruction set alone. Runs on all cores if there are enough pulses for that to be faster, else on this thread.
//
// A pulse without an answer of the table has the table's outcome and no number. A pulse is invalid if a number of the
// aircraft is (FindInvalid).
void QueryBudgetOnAllCores(const ColumnInterpolator& interpolator, const BudgetPulses& pulses,
                           const BudgetOptions& options, const BudgetAnswers& answers);

}  // namespace albtpu
