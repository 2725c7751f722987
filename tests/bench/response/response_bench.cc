// Time of the response theory on one core: of one beam, its sea included, and of the tables of seas, 20 x 18 x 22
// different beams and 4 depths.
//   one_beam            uniform and gaussian
//   compile/wind        the sea of a wind, whose waves have the harmonic 2 alone, as those of most buoys
//   compile/components  a wind sea and a swell across it, with all harmonics
//   compile/calm        no waves at all
//   correlation         of pulses: the whole of one sea, one beam and one cell of 1 m; and then each further beam, cell
//                       and pair of pulses
//   compiler            what is kept for all seas
//   interpolator        the table laid out for queries
#include <benchmark/benchmark.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "sea/correlation/pulse_correlation.h"
#include "sea/response/closed_form.h"
#include "sea/response/sea_response.h"
#include "sea/sea_state.h"
#include "sea/spectra/harmonic_spectrum.h"
#include "sea/spectra/jonswap.h"
#include "sea/table/sea_table.h"
#include "tables/query/column_query.h"

namespace albtpu::bench {
namespace {

// A wind sea with the harmonics of a measured spectrum.
HarmonicSpectrum Sea(std::size_t harmonics) {
  return Sampled(*WindSea{.wind_speed_10m = 8, .model = &kElfouhailyModel}.MakeSpectrum(), SeaWavenumbers(), harmonics);
}

void OneBeam(benchmark::State& state, BeamProfile profile) {
  const HarmonicSpectrum spectrum = Sea(state.range(0));
  const BeamOptions beam{.incidence = 0.3, .azimuth = 0.5, .footprint = 0.6, .profile = profile};
  for (auto _ : state) benchmark::DoNotOptimize(SeaResponse(spectrum, kRefractiveIndex)(beam));
}
BENCHMARK_CAPTURE(OneBeam, uniform, BeamProfile::kUniform)
    ->Name("one_beam/uniform")
    ->ArgName("harmonics")
    ->Arg(1)
    ->Arg(6)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(OneBeam, gaussian, BeamProfile::kGaussian)
    ->Name("one_beam/gaussian")
    ->ArgName("harmonics")
    ->Arg(1)
    ->Arg(6)
    ->Unit(benchmark::kMicrosecond);

constexpr BeamOptions kBeam = {.incidence = 0.3, .azimuth = 0.5, .footprint = 0.6};

void CorrelationOfOneCell(benchmark::State& state) {
  const HarmonicSpectrum spectrum = Sea(state.range(0));
  for (auto _ : state) {
    const WaveCorrelation sea(spectrum);
    const BeamCorrelation beam(sea, kBeam, kRefractiveIndex);
    benchmark::DoNotOptimize(CorrelationOf(beam.InCell({.side = 1}), beam.pulse()));
  }
}
BENCHMARK(CorrelationOfOneCell)
    ->Name("correlation/sea_beam_and_cell")
    ->ArgName("harmonics")
    ->Arg(1)
    ->Arg(6)
    ->Unit(benchmark::kMicrosecond);

void CorrelationOfAnotherBeam(benchmark::State& state) {
  const WaveCorrelation sea(Sea(6));
  for (auto _ : state) benchmark::DoNotOptimize(BeamCorrelation(sea, kBeam, kRefractiveIndex));
}
BENCHMARK(CorrelationOfAnotherBeam)->Name("correlation/beam")->Unit(benchmark::kMicrosecond);

void CorrelationOfAnotherCell(benchmark::State& state) {
  const WaveCorrelation sea(Sea(6));
  const BeamCorrelation beam(sea, kBeam, kRefractiveIndex);
  for (auto _ : state) benchmark::DoNotOptimize(beam.InCell({.side = 1}));
}
BENCHMARK(CorrelationOfAnotherCell)->Name("correlation/cell")->Unit(benchmark::kMicrosecond);

void CorrelationOfTwoPulses(benchmark::State& state, double later) {
  const WaveCorrelation sea(Sea(6));
  const BeamCorrelation beam(sea, kBeam, kRefractiveIndex);
  for (auto _ : state) benchmark::DoNotOptimize(beam.Between({1, 0.5}, later));
}
BENCHMARK_CAPTURE(CorrelationOfTwoPulses, at_once, 0)->Name("correlation/pair_at_once")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(CorrelationOfTwoPulses, later, 0.1)->Name("correlation/pair_later")->Unit(benchmark::kMicrosecond);

constexpr double kNotMeasured = std::numeric_limits<double>::infinity();

SeaDescription Wind(double wind_speed) { return {.wind_speed_10m = wind_speed, .wind_from = 0}; }

SeaDescription Components() {
  SeaDescription sea = Wind(6);
  sea.waves = std::make_shared<JonswapSpectrum>(std::vector<JonswapWaves>{
      {.significant_wave_height = 0.5, .peak_period = 3.2, .travels_towards = 3},
      {.significant_wave_height = 1.2, .peak_period = 9, .gamma = 7, .travels_towards = 2, .spread = 0.3}});
  return sea;
}

void Compile(benchmark::State& state, const SeaDescription& sea) {
  const SeaCompiler compiler;
  for (auto _ : state) {
    std::string digest = compiler.Compile(sea, kNotMeasured)->digest();
    benchmark::DoNotOptimize(digest);
  }
}
BENCHMARK_CAPTURE(Compile, wind, Wind(7))->Name("compile/wind")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Compile, components, Components())->Name("compile/components")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Compile, calm, Wind(0))->Name("compile/calm")->Unit(benchmark::kMillisecond);

void Compiler(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(std::make_unique<SeaCompiler>());
}
BENCHMARK(Compiler)->Name("compiler")->Unit(benchmark::kMillisecond);

void Interpolator(benchmark::State& state) {
  const UncertaintyTable table = SeaCompiler().Compile(Wind(7), kNotMeasured).value();
  for (auto _ : state) benchmark::DoNotOptimize(std::make_unique<ColumnInterpolator>(table));
}
BENCHMARK(Interpolator)->Name("interpolator")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace albtpu::bench

BENCHMARK_MAIN();
