// Time of the response theory on one core.
//   one_beam         one beam, its sea included; uniform and gaussian
// For all beams of a table: sea_table_bench.
#include <benchmark/benchmark.h>

#include "sea/response/closed_form.h"
#include "sea/response/sea_response.h"
#include "sea/sea_state.h"
#include "sea/spectra/harmonic_spectrum.h"

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

}  // namespace
}  // namespace albtpu::bench

BENCHMARK_MAIN();
