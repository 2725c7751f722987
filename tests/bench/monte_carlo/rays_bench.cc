// Rays traced, refracted and summed per second: the packet tracer against Embree in all its modes and against a scalar
// walk in double precision, over the same surface.
//
// Names are TRACER/INCIDENCE, in degrees. Items per second are rays; `lost` is the number of rays that found no
// surface, `miss_m` the greatest distance of a hit from that of the scalar walk, `means_off` the greatest difference of
// a mean.
#include <absl/strings/str_cat.h>
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sea/response/closed_form.h"
#include "tests/bench/monte_carlo/beam_case.h"
#ifdef ALBTPU_EMBREE
#include "tests/bench/monte_carlo/embree_tracer.h"
#endif

namespace albtpu::bench {
namespace {

constexpr double kDegree = 0.017453292519943295;
constexpr double kSameHit = 1e-5;    // m
constexpr double kSameMeans = 1e-5;  // a few of 10 000 rays take the facet on the other side of an edge

// Under a beam of one incidence: 10 000 rays, 128 points across the footprint, 7 m/s.
struct Bench {
  explicit Bench(int degrees)
      : beam_case({.size = 320, .wind_speed = 7, .incidence = degrees * kDegree}),
        floats(beam_case.Draw(1, beam_case.footprint_points())),
        surface(floats.InDouble()),
        rays(beam_case.SortedRays()) {
    for (const Ray& ray : rays) hit_heights.push_back(Intersect(surface, ray).height);
    means = MeansOf(Trace(rays, surface, kRefractiveIndex));
  }
  // The distance [m] along ray `r` between its hit at `height` and that of the scalar walk.
  double Miss(std::size_t r, double height) const {
    return std::abs(height - hit_heights[r]) / -beam_case.bundle().direction().z();
  }

  BeamCase beam_case;
  FloatSurface floats;
  HeightField surface;              // the same in double precision
  std::vector<Ray> rays;            // sorted, in single precision
  std::vector<double> hit_heights;  // by the scalar walk, of these rays
  BeamMeans means;
};

const Bench& BenchAt(int degrees) {
  static std::map<int, std::unique_ptr<Bench>> benches;
  std::unique_ptr<Bench>& bench = benches[degrees];
  if (!bench) bench = std::make_unique<Bench>(degrees);
  return *bench;
}

void CountRays(benchmark::State& state, const Bench& bench) {
  state.SetItemsProcessed(state.iterations() * bench.beam_case.options().rays);
}

void ScalarWalk(benchmark::State& state, const Bench& bench) {
  for (auto _ : state) benchmark::DoNotOptimize(Trace(bench.rays, bench.surface, kRefractiveIndex));
  CountRays(state, bench);
}

// Reports how far the results of a tracer are from those of the scalar walk, and ends its benchmark if that is too far.
bool Agrees(benchmark::State& state, const Bench& bench, const BeamMeans& means, double miss) {
  state.counters["lost"] = means.lost;
  state.counters["miss_m"] = miss;
  const double off = Difference(means, bench.means, bench.beam_case.options().footprint);
  state.counters["means_off"] = off;
  const bool agrees = miss <= kSameHit && off <= kSameMeans * (1 + means.lost);
  if (!agrees) state.SkipWithError("differs from the scalar walk");
  return agrees;
}

void Packets(benchmark::State& state, const Bench& bench) {
  double miss = 0;
  for (std::size_t r = 0; r < bench.rays.size(); ++r) {
    const RayBundle alone({bench.rays[r]}, kRefractiveIndex);
    miss = std::max(miss, bench.Miss(r, TracePackets(alone, bench.floats.View()).height));
  }
  const RayBundle& bundle = bench.beam_case.bundle();
  if (!Agrees(state, bench, MeansOf(Trace(bundle, bench.floats.View())), miss)) return;
  for (auto _ : state) benchmark::DoNotOptimize(Trace(bundle, bench.floats.View()));
  CountRays(state, bench);
}

// With the sums for the control variates.
void PacketsAndUnshifted(benchmark::State& state, const Bench& bench) {
  const RayBundle& bundle = bench.beam_case.bundle();
  for (auto _ : state) benchmark::DoNotOptimize(TracePackets(bundle, bench.floats.View()));
  CountRays(state, bench);
}

#ifdef ALBTPU_EMBREE
void Embree(benchmark::State& state, const Bench& bench, const EmbreeOptions& options) {
  EmbreeTracer tracer(options, bench.floats.points, bench.floats.spacing);
  tracer.SetHeights(bench.floats.heights.data());
  const BeamMeans means = tracer.Trace(bench.beam_case.sorted(), kRefractiveIndex);
  double miss = 0;
  for (std::size_t r = 0; r < bench.rays.size(); ++r) {
    const float height = tracer.hit_heights()[r];
    if (!std::isnan(height)) miss = std::max(miss, bench.Miss(r, height));
  }
  if (!Agrees(state, bench, means, miss)) return;
  for (auto _ : state) benchmark::DoNotOptimize(tracer.Trace(bench.beam_case.sorted(), kRefractiveIndex));
  CountRays(state, bench);
}

std::vector<EmbreeOptions> EmbreeModes() {
  std::vector<EmbreeOptions> modes;
  for (const EmbreeGeometry geometry : {EmbreeGeometry::kTriangles, EmbreeGeometry::kGrid}) {
    for (const EmbreeRays rays : kEmbreeRays) {
      for (const bool robust : {true, false})
        for (const bool coherent : {true, false})
          modes.push_back({.geometry = geometry, .rays = rays, .robust = robust, .coherent = coherent});
    }
  }
  return modes;
}
#endif

void RegisterAt(int degrees) {
  const std::string at = absl::StrCat("/", degrees);
  const auto add = [&](const std::string& name, auto run) {
    benchmark::RegisterBenchmark((name + at).c_str(), [=](benchmark::State& state) {
      run(state, BenchAt(degrees));
    })->MeasureProcessCPUTime();
  };
  add("packets", Packets);
  add("packets_and_unshifted", PacketsAndUnshifted);
  add("scalar", ScalarWalk);
#ifdef ALBTPU_EMBREE
  for (EmbreeOptions mode : EmbreeModes()) {
    mode.device = "isa=avx2";
    add(absl::StrCat("embree/avx2/", Name(mode)),
        [mode](auto& state, const Bench& bench) { Embree(state, bench, mode); });
    if (mode.robust || mode.coherent || mode.geometry == EmbreeGeometry::kGrid) continue;
    mode.device = "";  // with AVX-512 where the machine has it
    add(absl::StrCat("embree/any/", Name(mode)),
        [mode](auto& state, const Bench& bench) { Embree(state, bench, mode); });
  }
#endif
}

}  // namespace
}  // namespace albtpu::bench

int main(int argc, char** argv) {
#ifndef ALBTPU_EMBREE
  benchmark::AddCustomContext("embree", "absent when this was built");
#endif
  for (const int degrees : {0, 20}) albtpu::bench::RegisterAt(degrees);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
