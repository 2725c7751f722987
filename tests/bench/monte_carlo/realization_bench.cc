// One realization, from random numbers to centroid and path at five depths: 512 x 512 points of sea, 10 000 rays. For
// comparison, one FFTW transform of that size in single precision.
//
// Names are WHAT/INCIDENCE, in degrees. Ours compute 64 realizations at a time. Embree gets our fast surface, so that
// only the tracing differs: the whole patch or the part under the footprint, with a new or a refitted tree.
#include <absl/strings/str_cat.h>
#include <benchmark/benchmark.h>
#include <fftw3.h>

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "generator/kernels/fast_patch.h"
#include "generator/math/fft.h"
#include "sea/response/closed_form.h"
#include "tests/bench/monte_carlo/beam_case.h"
#include "tests/bench/monte_carlo/plain_realization.h"
#ifdef ALBTPU_EMBREE
#include "tests/bench/monte_carlo/embree_tracer.h"
#endif

namespace albtpu::bench {
namespace {

constexpr double kDegree = 0.017453292519943295;

const BeamCase& CaseAt(int degrees) {
  static std::mutex mutex;
  static std::map<int, std::unique_ptr<BeamCase>> cases;
  const std::lock_guard lock(mutex);
  std::unique_ptr<BeamCase>& of_degrees = cases[degrees];
  if (!of_degrees) of_degrees = std::make_unique<BeamCase>(CaseOptions{.incidence = degrees * kDegree});
  return *of_degrees;
}

void Plain(benchmark::State& state, const BeamCase& beam_case) {
  PlainRealization plain(beam_case);
  std::mt19937_64 random(1);
  for (auto _ : state) {
    plain.DrawSurface(random);
    benchmark::DoNotOptimize(plain.Trace(kRefractiveIndex));
  }
}

// Our fast surface with `points` along a side.
class FastSurface {
 public:
  FastSurface(const BeamCase& beam_case, int points)
      : patch_(beam_case.patch(), points), heights_(static_cast<std::size_t>(points) * points) {}

  const std::vector<float>& Draw(std::uint32_t realization) {
    patch_.Draw(BeamCase::Stream(realization), heights_, workspace_);
    return heights_;
  }

 private:
  FastPatch patch_;
  FastPatch::Workspace workspace_;
  std::vector<float> heights_;
};

// The realizations from `first` to `last` - 1.
void Realize(const BeamCase& beam_case, FastSurface& surface, std::uint32_t first, std::uint32_t last) {
  const int points = beam_case.footprint_points();
  const float spacing = static_cast<float>(beam_case.patch().spacing());
  for (std::uint32_t realization = first; realization < last; ++realization) {
    const HeightView view{surface.Draw(realization).data(), points, points, spacing};
    benchmark::DoNotOptimize(SpotsOf(MeansOf(Trace(beam_case.bundle(), view))));
  }
}

constexpr std::uint32_t kMany = 64;  // realizations, enough to make the start of a thread negligible

void Ours(benchmark::State& state, const BeamCase& beam_case) {
  FastSurface surface(beam_case, beam_case.footprint_points());
  for (auto _ : state) Realize(beam_case, surface, 0, kMany);
  state.SetItemsProcessed(state.iterations() * kMany);
}

void OursOnTwoThreads(benchmark::State& state, const BeamCase& beam_case) {
  FastSurface surface(beam_case, beam_case.footprint_points());
  FastSurface of_other(beam_case, beam_case.footprint_points());
  for (auto _ : state) {
    std::thread other([&] { Realize(beam_case, of_other, 0, kMany / 2); });
    Realize(beam_case, surface, kMany / 2, kMany);
    other.join();
  }
  state.SetItemsProcessed(state.iterations() * kMany);
}

#ifdef ALBTPU_EMBREE
void Embree(benchmark::State& state, const BeamCase& beam_case, const EmbreeOptions& options, bool whole) {
  const int points = whole ? beam_case.whole_points() : beam_case.footprint_points();
  FastSurface surface(beam_case, points);
  EmbreeTracer tracer(options, points, static_cast<float>(beam_case.patch().spacing()));
  std::uint32_t realization = 0;
  const float* heights = surface.Draw(realization).data();
  tracer.SetHeights(heights);  // the first tree is built, not refitted
  for (auto _ : state) {
    surface.Draw(++realization);
    tracer.SetHeights(heights);
    benchmark::DoNotOptimize(SpotsOf(tracer.Trace(beam_case.sorted(), kRefractiveIndex)));
  }
}
#endif

// One transform from modes to heights, in single precision.
void Transform(benchmark::State& state, unsigned planner) {
  constexpr int kSize = 512;
  fftwf_complex* modes = fftwf_alloc_complex(kSize * (kSize / 2 + 1));
  float* heights = fftwf_alloc_real(kSize * kSize);
  fftwf_plan plan;
  {
    const std::lock_guard lock(FftwPlanner());
    plan = fftwf_plan_dft_c2r_2d(kSize, kSize, modes, heights, planner | FFTW_DESTROY_INPUT);
  }
  for (int m = 0; m < kSize * (kSize / 2 + 1); ++m) modes[m][0] = modes[m][1] = 0;  // avoids overflow
  for (auto _ : state) {
    fftwf_execute(plan);
    benchmark::ClobberMemory();
  }
  const std::lock_guard lock(FftwPlanner());
  fftwf_destroy_plan(plan);
  fftwf_free(modes);
  fftwf_free(heights);
}

void RegisterAt(int degrees) {
  const auto add = [&](const std::string& name, auto run) {
    return benchmark::RegisterBenchmark(absl::StrCat(name, "/", degrees).c_str(),
                                        [=](benchmark::State& state) { run(state, CaseAt(degrees)); })
        ->MeasureProcessCPUTime()
        ->Unit(benchmark::kMicrosecond);
  };
  add("ours", Ours);
  add("ours_on_two_threads", OursOnTwoThreads);
  add("plain", Plain);
#ifdef ALBTPU_EMBREE
  for (const bool whole : {true, false}) {
    for (const EmbreeGeometry geometry : {EmbreeGeometry::kTriangles, EmbreeGeometry::kGrid}) {
      for (const EmbreeBuild build : {EmbreeBuild::kRefit, EmbreeBuild::kLow, EmbreeBuild::kMedium}) {
        const EmbreeOptions options{
            .geometry = geometry, .build = build, .robust = false, .coherent = false, .device = "isa=avx2"};
        add(absl::StrCat("embree/", whole ? "whole/" : "cropped/", Name(options)),
            [=](auto& state, const BeamCase& of) { Embree(state, of, options, whole); });
      }
    }
  }
#endif
}

}  // namespace
}  // namespace albtpu::bench

int main(int argc, char** argv) {
#ifndef ALBTPU_EMBREE
  benchmark::AddCustomContext("embree", "absent when this was built");
#endif
  using albtpu::bench::Transform;
  benchmark::RegisterBenchmark("transform/estimated", Transform, FFTW_ESTIMATE)->Unit(benchmark::kMicrosecond);
  benchmark::RegisterBenchmark("transform/measured", Transform, FFTW_MEASURE)->Unit(benchmark::kMicrosecond);
  for (const int degrees : {0, 20}) albtpu::bench::RegisterAt(degrees);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
