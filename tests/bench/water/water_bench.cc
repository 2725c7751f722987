// The share of the water column of a survey: to prepare it, and then for many pulses.
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "budget/water/water_share.h"
#include "tables/file/table_io.h"

namespace {

using namespace albtpu;

const WaterColumnTable& Shipped() {
  static const auto* const table =
      new WaterColumnTable(*WaterColumnTable::Create(*ReadTable(SHIPPED_WATER_TABLE, kWaterColumn)));
  return *table;
}

WaterShare Share() {
  return *WaterShare::Create(Shipped(), *OpticsOf({.kd = 0.12, .kd_kind = KdKind::kDiffuse532}),
                             {.detector = EchoDetector::kPeak, .field_of_view = 6, .pulse_length = 1.5}, {});
}

struct Pulses {
  static constexpr std::size_t kCount = 1 << 16;
  std::vector<float> incidence, depth;
  std::vector<std::vector<float>> columns = std::vector<std::vector<float>>(6, std::vector<float>(kCount));

  explicit Pulses(double deepest) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> even(0, 1);
    for (std::size_t i = 0; i < kCount; ++i) {
      incidence.push_back(25 * even(random));
      depth.push_back(static_cast<float>(deepest) * even(random));
    }
  }
};

void Bias(benchmark::State& state) {
  const WaterShare share = Share();
  Pulses pulses(share.greatest_depth());
  WaterColumns columns;
  columns.bias_along = pulses.columns[0];
  columns.bias_vertical = pulses.columns[1];
  for (auto _ : state) share.Compute(pulses.incidence, pulses.depth, columns);
  state.SetItemsProcessed(state.iterations() * Pulses::kCount);
}
BENCHMARK(Bias);

void BiasAndWhatIsUnknown(benchmark::State& state) {
  const WaterShare share = Share();
  Pulses pulses(share.greatest_depth());
  const WaterColumns columns{.bias_along = pulses.columns[0],
                             .bias_vertical = pulses.columns[1],
                             .sigma_along = pulses.columns[2],
                             .sigma_vertical = pulses.columns[3],
                             .correlation = pulses.columns[4],
                             .stretch = pulses.columns[5]};
  for (auto _ : state) share.Compute(pulses.incidence, pulses.depth, columns);
  state.SetItemsProcessed(state.iterations() * Pulses::kCount);
}
BENCHMARK(BiasAndWhatIsUnknown);

void Prepare(benchmark::State& state) {
  Shipped();
  for (auto _ : state) benchmark::DoNotOptimize(Share());
}
BENCHMARK(Prepare)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
