// The peers of the benchmarks compute the same as our code; otherwise ratios would have no meaning.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "generator/kernels/fast_patch.h"
#include "sea/response/closed_form.h"
#include "tests/bench/monte_carlo/beam_case.h"
#include "tests/bench/monte_carlo/plain_realization.h"
#ifdef ALBTPU_EMBREE
#include "tests/bench/monte_carlo/embree_tracer.h"
#endif

namespace albtpu::bench {
namespace {

constexpr double kIncidences[] = {0, 0.35};

BeamCase SmallCase(double incidence) {
  return BeamCase({.size = 96, .wind_speed = 12, .incidence = incidence, .rays = 1500});
}

// The means of a beam by the scalar walk in double precision.
BeamMeans Exact(const BeamCase& beam_case, const FloatSurface& surface) {
  return MeansOf(Trace(beam_case.rays(), surface.InDouble(), kRefractiveIndex));
}

// The heights of `surface` (about 0.01 m) on the points of the patch as in PlainRealization, with zeros around them.
std::vector<double> AroundTheCentre(const BeamCase& beam_case, const FloatSurface& surface) {
  const int size = beam_case.options().size;
  std::vector<double> heights(static_cast<std::size_t>(size) * size, 0.0);
  const int first = size / 2 - (surface.points - 1) / 2;
  for (int i = 0; i < surface.points; ++i)
    for (int j = 0; j < surface.points; ++j)
      heights[static_cast<std::size_t>(first + i) * size + first + j] = surface.heights[i * surface.points + j];
  return heights;
}

TEST(PacketTracer, IntersectsTheSurfaceWhereTheScalarWalkDoes) {
  for (const double incidence : kIncidences) {
    const BeamCase beam_case = SmallCase(incidence);
    const FloatSurface surface = beam_case.Draw(1, beam_case.footprint_points());
    const HeightField twin = surface.InDouble();
    for (const Ray& ray : beam_case.SortedRays()) {
      const double height = TracePackets(RayBundle({ray}, kRefractiveIndex), surface.View()).height;
      ASSERT_NEAR(height, Intersect(twin, ray).height, 1e-5 * std::cos(incidence));
    }
    const BeamMeans means = MeansOf(Trace(beam_case.bundle(), surface.View()));
    // One ray that meets an edge within rounding may take the facet on the other side.
    EXPECT_LT(Difference(means, Exact(beam_case, surface), beam_case.options().footprint),
              1.0 / beam_case.bundle().count());
  }
}

TEST(OurRealization, HasTheMeansOfTheSlowTwin) {
  for (const double incidence : kIncidences) {
    const BeamCase beam_case = SmallCase(incidence);
    FloatSurface fast = beam_case.Draw(1, beam_case.footprint_points());
    const BeamMeans expected = Exact(beam_case, fast);
    std::fill(fast.heights.begin(), fast.heights.end(), 0.0f);
    FastPatch::Workspace workspace;
    FastPatch(beam_case.patch(), fast.points).Draw(BeamCase::Stream(1), fast.heights, workspace);
    const BeamMeans means = MeansOf(Trace(beam_case.bundle(), fast.View()));
    EXPECT_LT(Difference(means, expected, beam_case.options().footprint), 1.0 / beam_case.bundle().count());
  }
}

TEST(PlainRealization, PutsTheSpotWhereTheScalarWalkDoes) {
  for (const double incidence : kIncidences) {
    const BeamCase beam_case = SmallCase(incidence);
    const FloatSurface surface = beam_case.Draw(1, beam_case.footprint_points());
    PlainRealization plain(beam_case);
    plain.SetSurface(AroundTheCentre(beam_case, surface));
    const Spots spots = plain.Trace(kRefractiveIndex);
    const Spots expected = SpotsOf(Exact(beam_case, surface));
    // The spacing of the surface is a float, which has a relative error of 6e-8; so have slopes and tangents.
    for (std::size_t d = 0; d < spots.size(); ++d) {
      EXPECT_NEAR(spots[d].x, expected[d].x, 1e-6 * kDepths[d]);
      EXPECT_NEAR(spots[d].y, expected[d].y, 1e-6 * kDepths[d]);
      EXPECT_NEAR(spots[d].path, expected[d].path, 1e-6 * kDepths[d]);
    }
  }
}

TEST(PlainRealization, DrawsTheSeaOfThePatch) {
  const BeamCase beam_case = SmallCase(0);
  PlainRealization plain(beam_case);
  std::mt19937_64 random(1);
  constexpr int kSurfaces = 400;
  double sum = 0, sum_of_squares = 0;
  for (int surface = 0; surface < kSurfaces; ++surface) {
    plain.DrawSurface(random);
    double variance = 0;
    for (const double height : plain.heights()) variance += height * height / plain.heights().size();
    sum += variance / kSurfaces;
    sum_of_squares += variance * variance / kSurfaces;
  }
  const double standard_error = std::sqrt((sum_of_squares - sum * sum) / kSurfaces);
  EXPECT_NEAR(sum, beam_case.patch().elevation_variance(), 4 * standard_error);
}

#ifdef ALBTPU_EMBREE
std::vector<EmbreeOptions> AllModes() {
  std::vector<EmbreeOptions> modes;
  for (const EmbreeGeometry geometry : {EmbreeGeometry::kTriangles, EmbreeGeometry::kGrid}) {
    for (const EmbreeBuild build : {EmbreeBuild::kHigh, EmbreeBuild::kRefit}) {
      for (const EmbreeRays rays : kEmbreeRays) {
        for (const bool robust : {true, false})
          modes.push_back({.geometry = geometry, .build = build, .rays = rays, .robust = robust, .coherent = false});
      }
    }
  }
  return modes;
}

TEST(EmbreeTracer, IntersectsTheSurfaceWhereTheScalarWalkDoesInAllItsModes) {
  for (const double incidence : kIncidences) {
    const BeamCase beam_case = SmallCase(incidence);
    const FloatSurface first = beam_case.Draw(1, beam_case.footprint_points());
    const FloatSurface second = beam_case.Draw(2, beam_case.footprint_points());
    const HeightField surface = second.InDouble();
    const std::vector<Ray> rays = beam_case.SortedRays();
    const BeamMeans expected = Exact(beam_case, second);
    for (const EmbreeOptions& mode : AllModes()) {
      SCOPED_TRACE(Name(mode));
      EmbreeTracer tracer(mode, second.points, second.spacing);
      tracer.SetHeights(first.heights.data());
      tracer.SetHeights(second.heights.data());
      const BeamMeans means = tracer.Trace(beam_case.sorted(), kRefractiveIndex);
      // Rays that meet an edge within rounding may be lost or take the facet on the other side, in robust mode too.
      // Such rays are few, and each changes a mean by less than 1 / rays.
      const double rays_aside = mode.robust ? 1 : 5;
      EXPECT_LE(means.lost, mode.robust ? 0 : 5);
      EXPECT_LT(Difference(means, expected, beam_case.options().footprint), rays_aside / rays.size());
      for (std::size_t r = 0; r < rays.size(); ++r) {
        if (std::isnan(tracer.hit_heights()[r])) continue;
        const double height = Intersect(surface, rays[r]).height;
        ASSERT_NEAR(tracer.hit_heights()[r], height, 1e-5 * std::cos(incidence));
      }
    }
  }
}
#else
TEST(EmbreeTracer, IntersectsTheSurfaceWhereTheScalarWalkDoesInAllItsModes) {
  GTEST_SKIP() << "built without Embree (libembree-dev)";
}
#endif

}  // namespace
}  // namespace albtpu::bench
