// Time of the response theory on one core.
//   compile_sea      all 560 beams of a table: 10 incidences, 4 azimuths, 14 footprints
//   one_beam         one beam, its sea included; uniform and gaussian
#include <benchmark/benchmark.h>

#include <vector>

#include "sea/response/compiled_sea.h"
#include "sea/response/refraction.h"
#include "sea/spectra/harmonic_spectrum.h"
#include "sea/wave_state.h"

namespace albtpu::bench {
namespace {

// A wind sea with the harmonics of a measured spectrum.
HarmonicSpectrum Sea(std::size_t harmonics) {
  return Sampled(*WindSea{.wind_speed_10m = 8, .model = &kElfouhailyModel}.MakeSpectrum(), SeaWavenumbers(),
                 harmonics);
}

void CompileSea(benchmark::State& state) {
  const BeamGrid grid({0, 0.0065, 0.0175, 0.0327, 0.0524, 0.0873, 0.153, 0.244, 0.34, 0.436},
                      {0, 0.785, 1.571, 2.356},
                      {0.1, 0.212, 0.448, 0.832, 1.15, 1.45, 1.82, 2.14, 2.52, 2.97, 3.38, 3.85, 4.39, 5},
                      BeamProfile::kUniform);
  const HarmonicSpectrum spectrum = Sea(state.range(0));
  for (auto _ : state) {
    const CompiledSea sea(SeaResponse(spectrum, kRefractiveIndex), grid);
    benchmark::DoNotOptimize(sea.At(0, 0, 0));
  }
}
BENCHMARK(CompileSea)
    ->Name("compile_sea")
    ->ArgName("harmonics")
    ->Arg(1)
    ->Arg(6)
    ->Unit(benchmark::kMillisecond);

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

}  // namespace
}  // namespace albtpu::bench

BENCHMARK_MAIN();
