// Pulses per second of the geometry of pulses along a flight line at 400 m with a 20 degree cone, 300 pulses in a turn.
//   columns          ComputeBeams, all four columns
//   plain            the same by the standard library, one pulse after the other
//   add              returns of the surface added to SurfaceReturns
//   height           heights read from a LocalWaterSurface by its Reader
//   finish           SurfaceReturns::Finish, in returns per second
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include "budget/beams/beam_columns.h"
#include "budget/beams/refracted_path.h"
#include "budget/beams/water_surface.h"
#include "sea/response/closed_form.h"

namespace albtpu::bench {
namespace {

constexpr std::size_t kPulses = std::size_t{1} << 20, kBatch = std::size_t{1} << 14;
constexpr double kAltitude = 400, kSpeed = 60, kPulseRate = 100'000, kPulsesInATurn = 300;  // m, m/s, 1/s

struct FlightLine {
  FlightLine() {
    std::mt19937_64 random(1);
    std::normal_distribution<double> waves(0, 0.12);
    for (std::size_t i = 0; i < kPulses; ++i) {
      const double turn = 2 * std::numbers::pi * static_cast<double>(i) / kPulsesInATurn;
      const double radius = kAltitude * std::tan(20 * std::numbers::pi / 180);
      const double bottom = 8 + 6 * std::sin(static_cast<double>(i) / 9000);
      time.push_back(static_cast<double>(i) / kPulseRate);
      east.push_back(radius * std::sin(turn));
      north.push_back(radius * std::cos(turn));
      height.push_back(kAltitude + waves(random));
      depth.push_back(bottom);
      surface.push_back(waves(random));
    }
  }
  double x(std::size_t i) const { return east[i] + kSpeed * time[i]; }

  std::vector<double> time, east, north, height, depth, surface;
};

const FlightLine& Line() {
  static const FlightLine line;
  return line;
}

void Columns(benchmark::State& state) {
  const FlightLine& line = Line();
  const std::vector<double> convergence = {0.02};
  std::vector<double> incidence(kBatch), azimuth(kBatch), slant_range(kBatch), water_path(kBatch);
  for (auto _ : state) {
    for (std::size_t begin = 0; begin < kPulses; begin += kBatch) {
      const auto rows = [begin](const std::vector<double>& column) { return std::span(column).subspan(begin, kBatch); };
      ComputeBeams({rows(line.east), rows(line.north), rows(line.height), rows(line.depth), convergence},
                   kRefractiveIndex, {incidence, azimuth, slant_range, water_path});
      benchmark::ClobberMemory();
    }
  }
  state.SetItemsProcessed(state.iterations() * kPulses);
}
BENCHMARK(Columns)->Name("columns")->Unit(benchmark::kMillisecond);

void Plain(benchmark::State& state) {
  const FlightLine& line = Line();
  for (auto _ : state) {
    for (std::size_t i = 0; i < kPulses; ++i) {
      const double distance = std::hypot(line.east[i], line.north[i]), depth = line.depth[i];
      const double r = DistanceToWater(distance, line.height[i], depth, kRefractiveIndex);
      benchmark::DoNotOptimize(std::atan2(r, line.height[i]));
      benchmark::DoNotOptimize(std::atan2(line.east[i], line.north[i]));
      benchmark::DoNotOptimize(std::hypot(r, line.height[i]));
      benchmark::DoNotOptimize(std::hypot(distance - r, depth));
    }
  }
  state.SetItemsProcessed(state.iterations() * kPulses);
}
BENCHMARK(Plain)->Name("plain")->Unit(benchmark::kMillisecond);

SurfaceReturns Collect() {
  const FlightLine& line = Line();
  SurfaceReturns returns;
  for (std::size_t i = 0; i < kPulses; ++i) returns.Add(line.x(i), line.north[i], line.time[i], line.surface[i]);
  return returns;
}

void Add(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(Collect().bytes());
  state.SetItemsProcessed(state.iterations() * kPulses);
}
BENCHMARK(Add)->Name("add")->Unit(benchmark::kMillisecond);

void Finish(benchmark::State& state) {
  const SurfaceReturns returns = Collect();
  for (auto _ : state) benchmark::DoNotOptimize(returns.Finish());
  state.SetItemsProcessed(state.iterations() * kPulses);
}
BENCHMARK(Finish)->Name("finish")->Unit(benchmark::kMillisecond);

void Height(benchmark::State& state) {
  const FlightLine& line = Line();
  const LocalWaterSurface surface = Collect().Finish();
  LocalWaterSurface::Reader reader(surface);
  for (auto _ : state) {
    double sum = 0;
    for (std::size_t i = 0; i < kPulses; ++i)
      sum += reader.HeightAt(line.x(i), line.north[i], line.time[i]).value_or(0);
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * kPulses);
}
BENCHMARK(Height)->Name("height")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace albtpu::bench

BENCHMARK_MAIN();
