// Pulses answered by the sea at their times: a month of hourly spectra, 300 000 pulses an hour along a flight line.
//   compile     a sea into its table
//   month       all hours one after the other: each sea is compiled once, each pulse interpolated between two
//   hour        the same pulses within one hour, whose two seas are compiled already
//   one_sea     the same pulses over one sea at one instant
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "annotate/answers/uncertainty_summary.h"
#include "annotate/seas/sea_answers.h"
#include "formats/files/ordered_pipeline.h"
#include "tests/annotate/seas/sea_series_text.h"
#include "tests/temporary_folder.h"

namespace albtpu::bench {
namespace {

using namespace albtpu::annotate;
using namespace albtpu::client;
using namespace albtpu::formats;

constexpr double kHour = 3600, kStart = 1591588800;
constexpr std::size_t kHours = 720, kBatch = 50'000, kBatchesAnHour = 6;

template <typename T>
T Must(absl::StatusOr<T> result) {
  if (result.ok()) return *std::move(result);
  std::cerr << "seas_bench: " << result.status() << "\n";
  std::exit(1);
}

std::shared_ptr<const SeaTimeline> Month(const std::string& time = "") {
  std::vector<albtpu::testing::SeaAtTime> seas;
  for (std::size_t i = 0; i <= kHours; ++i) {
    const auto hour = static_cast<double>(i);
    seas.push_back({kStart + hour * kHour, 0.5 + 0.3 * std::sin(hour / 9), 200 + 40 * std::sin(hour / 31)});
  }
  const albtpu::testing::TemporaryFolder folder;
  config::SeaSettings settings;
  settings.file = folder.Write("month.csv", albtpu::testing::SeaCsv(seas)).string();
  settings.wind_speed = 6;
  if (!time.empty()) settings.time = time;
  return std::make_shared<const SeaTimeline>(Must(SeaTimeline::Open(settings)));
}

// A conical scan over a bottom that rises and falls.
PulseBatch Pulses(double start) {
  PulseBatch pulses{.size = kBatch, .axis = {}, .azimuths_from_north = true};
  pulses[AxisId::kFootprint] = {0.6f};
  for (std::size_t i = 0; i < kBatch; ++i) {
    const auto at = static_cast<double>(i);
    pulses[AxisId::kIncidence].push_back(static_cast<float>(19 + std::sin(at / 300)));
    pulses[AxisId::kAzimuth].push_back(static_cast<float>(std::fmod(at * 1.2, 360)));
    pulses[AxisId::kDepth].push_back(static_cast<float>(8 - 6 * std::sin(at / 9000)));
    pulses.times.push_back(start + at * kHour / (kBatch * kBatchesAnHour));
  }
  return pulses;
}

struct Chunk {
  PulseBatch pulses;
  AnswerBatch answers;
  AnswerSelection selection;
};

// Asks batches of pulses as files do: in order, on all cores.
void Ask(benchmark::State& state, std::shared_ptr<const SeaTimeline> timeline, std::size_t batches, bool in_one_hour) {
  const PulseBatch pulses = Pulses(0);
  for (auto _ : state) {
    const std::unique_ptr<SeaAnswers> seas = Must(SeaAnswers::Open(timeline, LocalSeas()));
    const AnswerSource source = seas->source();
    std::size_t next = 0;
    const absl::Status status = RunOrderedPipeline(
        [&] {
          Chunk chunk{.pulses = pulses, .answers = {}, .selection = {}};
          UncertaintySummary::Select(chunk.selection);
          return chunk;
        },
        [&](Chunk& chunk) -> absl::StatusOr<bool> {
          if (next == batches) return false;
          const std::size_t step = in_one_hour ? next % kBatchesAnHour : next;
          const double start = kStart + static_cast<double>(step) * kHour / kBatchesAnHour;
          for (std::size_t i = 0; i < kBatch; ++i) chunk.pulses.times[i] = start + pulses.times[i];
          ++next;
          return true;
        },
        [&](Chunk& chunk) { return AnswerPulses(source, {}, chunk.pulses, chunk.selection, chunk.answers); },
        [&](Chunk& chunk) {
          benchmark::DoNotOptimize(chunk.answers.values[Index(Quantity::kThu)].data());
          return absl::OkStatus();
        });
    if (!status.ok()) state.SkipWithError("ERROR OCCURRED: a batch has no answer");
  }
  state.SetItemsProcessed(state.iterations() * batches * kBatch);
}

void Compile(benchmark::State& state) {
  const std::shared_ptr<const SeaTimeline> month = Month();
  const std::unique_ptr<SeaSources> sources = LocalSeas();
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(Must(sources->Open(month->sea(i++ % kHours))));
}

BENCHMARK(Compile)->Name("compile")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Ask, month, Month(), kHours* kBatchesAnHour, false)
    ->Name("month")
    ->Iterations(1)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Ask, hour, Month(), 100, true)
    ->Name("hour")
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Ask, one_sea, Month("2020-06-08T04:00Z"), 100, true)
    ->Name("one_sea")
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace albtpu::bench

BENCHMARK_MAIN();
