// Covariance and combination of the whole budget, one core.
//   columns/2sigma    ComputeBudget, THU and TVU
//   columns/p95       the same at 95 %, with the order of S-44
//   columns/details   with all shares and the covariance of the total
//   plain_double      the same sums as columns/2sigma, a pulse at a time, in double precision, as one would write them
#include <benchmark/benchmark.h>

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "budget/air/air_sources.h"
#include "budget/total/budget_columns.h"
#include "tests/bench/budget/plain_budget.h"
#include "tests/budget/query/budget_memory.h"

namespace albtpu::bench {
namespace {

constexpr std::size_t kPulses = 16384;

struct Columns {
  Columns() {
    std::mt19937 random(1);
    const auto draw = [&](BudgetInput input, double least, double most) {
      std::uniform_real_distribution<double> between(least, most);
      for (std::size_t i = 0; i < kPulses; ++i)
        numbers[static_cast<std::size_t>(input)].push_back(static_cast<float>(between(random)));
    };
    draw(BudgetInput::kIncidence, 15, 25);
    draw(BudgetInput::kBeamAzimuth, 0, 360);
    draw(BudgetInput::kAltitude, 380, 420);
    draw(BudgetInput::kDepth, 0, 20);
    draw(BudgetInput::kRoll, -3, 3);
    draw(BudgetInput::kPitch, -3, 3);
    draw(BudgetInput::kHeading, 28, 32);
    for (const auto input : {BudgetInput::kVelocityNorth, BudgetInput::kVelocityEast, BudgetInput::kVelocityDown,
                             BudgetInput::kRollRate, BudgetInput::kPitchRate, BudgetInput::kYawRate})
      draw(input, -5, 50);
    draw(BudgetInput::kSeaThu, 0.1, 0.5);
    draw(BudgetInput::kSeaTvu, 0.05, 0.1);
    draw(BudgetInput::kRefractionAlong, 1, 2);
    draw(BudgetInput::kRefractionCross, 1, 2);
    draw(BudgetInput::kBiasVertical, 0, 0.01);
    numbers[static_cast<std::size_t>(BudgetInput::kSeaAxis)] = {70};
    numbers[static_cast<std::size_t>(BudgetInput::kWaveHeight)] = {0.2f};
    for (std::size_t i = 0; i < kBudgetInputCount; ++i) inputs.columns[i] = numbers[i];
    inputs.size = kPulses;
  }
  std::array<std::vector<float>, kBudgetInputCount> numbers;
  BudgetInputs inputs;
};

BudgetOptions Options(Coverage coverage) {
  BudgetOptions options = testing::UsualOptions();
  options.coverage = coverage;
  return options;
}

void InColumns(benchmark::State& state, Coverage coverage, bool orders, bool details) {
  const Columns columns;
  std::array<std::vector<float>, 12> numbers;
  for (auto& column : numbers) column.resize(kPulses);
  std::vector<std::uint8_t> best(kPulses);
  BudgetOutputs outputs{.thu = numbers[0], .tvu = numbers[1]};
  if (orders) outputs.best_orders = best;
  if (details) {
    outputs.thu_air = numbers[2];
    outputs.tvu_air = numbers[3];
    outputs.thu_sea = numbers[4];
    outputs.tvu_sea = numbers[5];
    for (std::size_t i = 0; i < 6; ++i) outputs.total[i] = numbers[6 + i];
  }
  const BudgetOptions options = Options(coverage);
  for (auto _ : state) {
    ComputeBudget(columns.inputs, options, outputs);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * kPulses));
}

void PlainDouble(benchmark::State& state) {
  const Columns columns;
  std::vector<double> thu(kPulses), tvu(kPulses);
  const BudgetOptions options = Options(Coverage::kTwoSigma);
  for (auto _ : state) {
    for (std::size_t i = 0; i < kPulses; ++i) PlainBudget(columns.inputs, i, options, thu[i], tvu[i]);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * kPulses));
}

BENCHMARK_CAPTURE(InColumns, two_sigma, Coverage::kTwoSigma, false, false)->Name("columns/2sigma");
BENCHMARK_CAPTURE(InColumns, p95, Coverage::kP95, true, false)->Name("columns/p95");
BENCHMARK_CAPTURE(InColumns, details, Coverage::kP95, true, true)->Name("columns/details");
BENCHMARK(PlainDouble)->Name("plain_double");

}  // namespace
}  // namespace albtpu::bench

BENCHMARK_MAIN();
