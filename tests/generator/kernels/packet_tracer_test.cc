#include "generator/kernels/packet_tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "generator/math/random_stream.h"
#include "generator/surface/sea_surface.h"
#include "sea/response/closed_form.h"
#include "tests/degree.h"
#include "tests/instruction_sets.h"

namespace albtpu {
namespace {

constexpr double kN = kRefractiveIndex;
using albtpu::testing::kDegree;
constexpr double kHeightTolerance = 1e-6;        // m, on surfaces about a metre wide
constexpr double kSumRounding = 64 * 0x1p-24;    // relative, of 64 numbers of one sign in single precision
constexpr double kNumberRounding = 8 * 0x1p-24;  // relative, of one number after a few operations

// A surface in both precisions, with heights that single precision holds exactly.
class Surface {
 public:
  Surface(const std::vector<double>& heights, int points, double spacing, int padding = 0)
      : floats_((points + padding) * points, 1e9f),
        view_{nullptr, points, points + padding, static_cast<float>(spacing)},
        field_(Rounded(heights), points, view_.spacing) {
    for (int ix = 0; ix < points; ++ix)
      for (int iy = 0; iy < points; ++iy)
        floats_[ix * view_.stride + iy] = static_cast<float>(heights[ix * points + iy]);
    view_.heights = floats_.data();
  }
  const HeightView& view() const { return view_; }
  const HeightField& field() const { return field_; }

 private:
  static std::vector<double> Rounded(std::vector<double> heights) {
    for (double& height : heights) height = static_cast<float>(height);
    return heights;
  }
  std::vector<float> floats_;
  HeightView view_;
  HeightField field_;
};

constexpr int kPoints = 31;
constexpr double kSpacing = 0.04;

// Independent heights, whose facets have a root mean square slope of about `slope` along each axis.
std::vector<double> RoughHeights(std::uint32_t realization, double slope) {
  std::vector<double> heights(kPoints * kPoints);
  NormalStream(5, 0, realization).Fill(heights);
  for (double& height : heights) height *= slope * kSpacing / std::sqrt(2.0);
  return heights;
}
Surface RoughWater(std::uint32_t realization, double slope = 0.15) {
  return Surface(RoughHeights(realization, slope), kPoints, kSpacing);
}

Surface Plane(const Eigen::Vector2d& slope, double height = 0) {
  std::vector<double> heights;
  for (int ix = -15; ix <= 15; ++ix)
    for (int iy = -15; iy <= 15; ++iy) heights.push_back(height + slope.dot(Eigen::Vector2d(ix, iy)) / 16);
  return Surface(heights, 31, 1.0 / 16);
}

struct Twin {
  TracedBeam beam;
  double height = 0;
  Eigen::Vector2d unshifted_slope = Eigen::Vector2d::Zero();
  Eigen::Vector3d unshifted_slope_squares = Eigen::Vector3d::Zero();
  Eigen::Vector2d unshifted_height_slope = Eigen::Vector2d::Zero();
};
Twin SlowTwin(const std::vector<Ray>& rays, const HeightField& surface) {
  Twin twin;
  twin.beam = Trace(rays, surface, kN);
  double unshifted_height = 0;
  for (const Ray& ray : rays) {
    const HeightField::Facet facet = surface.FacetAt(ray.at_zero);
    const Eigen::Vector2d slope = facet.slope;
    const double height = facet.HeightAt(ray.at_zero) / rays.size();
    unshifted_height += height;
    twin.unshifted_height_slope += height * slope;
    twin.height += Intersect(surface, ray).height / rays.size();
    twin.unshifted_slope += slope / rays.size();
    twin.unshifted_slope_squares += SlopeSquares(slope) / rays.size();
  }
  twin.unshifted_height_slope -= unshifted_height * twin.unshifted_slope;
  return twin;
}

// `slope` is the root mean square slope along each axis. A ray within rounding of an edge may take the facet on the
// other side. At most one of so few rays does, and neighbouring facets differ by at most about 6 `slope`.
void ExpectEqual(const TracedBundle& fast, const Twin& slow, int rays, double slope) {
  const double sum = kSumRounding * slope + 6 * slope / rays;
  const double product = kHeightTolerance * slope + sum * 0.1;  // heights are below 0.1 m
  EXPECT_NEAR(fast.height, slow.height, kHeightTolerance);
  EXPECT_LT((fast.beam.slope - slow.beam.slope).norm(), sum);
  EXPECT_LT((fast.beam.slope_squares - slow.beam.slope_squares).norm(), sum * slope);
  EXPECT_LT((fast.unshifted_slope - slow.unshifted_slope).norm(), sum);
  EXPECT_LT((fast.unshifted_slope_squares - slow.unshifted_slope_squares).norm(), sum * slope);
  EXPECT_LT((fast.unshifted_height_slope - slow.unshifted_height_slope).norm(), product);
  EXPECT_LT((fast.beam.tangent - slow.beam.tangent).norm(), sum);
  EXPECT_NEAR(fast.beam.secant, slow.beam.secant, sum);
  EXPECT_LT((fast.beam.height_tangent - slow.beam.height_tangent).norm(), product);
  EXPECT_NEAR(fast.beam.height_secant, slow.beam.height_secant, product);
}

class PacketTracer : public testing::OnInstructionSet {};
ALBTPU_ON_EACH_INSTRUCTION_SET(PacketTracer);

TEST_P(PacketTracer, EqualsTheDoubleTwinOnRoughWater) {
  constexpr double kSlope = 0.15;
  for (const double incidence : {0.0, 5.0, 12.0, 20.0, 25.0}) {
    const Beam beam({.incidence = incidence * kDegree, .azimuth = 0.7, .footprint = 0.9}, 2000);
    for (std::uint32_t realization = 0; realization < 10; ++realization) {
      const Surface surface = RoughWater(realization, kSlope);
      ExpectEqual(TracePackets(RayBundle(beam, kN), surface.view()), SlowTwin(beam.Rays(0), surface.field()), 2000,
                  kSlope);
    }
  }
}

TEST_P(PacketTracer, EqualsTheDoubleTwinUnderASea) {
  const SeaState sea(7, 1e5);
  const BeamOptions options{.incidence = 0.3, .azimuth = 0.7, .footprint = 0.5};
  const SurfaceModel model(sea, options, {2.0, 64, 2000});
  const Beam beam(options, 2000);
  const HeightField field = SeaSurface(model, NormalStream(1, 2, 3)).SurfaceUnder(beam).heights;
  const Surface surface(field.heights(), field.points(), field.spacing());
  ExpectEqual(TracePackets(RayBundle(beam, kN), surface.view()), SlowTwin(beam.Rays(0), surface.field()), 2000, 0.3);
}

// One ray at a time, so that no errors average out.
TEST_P(PacketTracer, IntersectsTheWaterWhereTheDoubleTwinDoes) {
  const Surface surface = RoughWater(3);
  for (const double incidence : {0.0, 0.3, 0.44}) {
    for (const Ray& ray : Beam({.incidence = incidence, .azimuth = 2, .footprint = 0.9}, 500).Rays(0)) {
      const TracedBundle traced = TracePackets(RayBundle(std::vector<Ray>{ray}, kN), surface.view());
      EXPECT_NEAR(traced.height, Intersect(surface.field(), ray).height, kHeightTolerance);
    }
  }
}

TEST_P(PacketTracer, CountsEveryRayOnce) {
  const Surface surface = RoughWater(1);
  for (const int rays : {1, 2, 7, 8, 9, 15, 16, 17, 100, 1023, 1024, 1025, 2500}) {
    for (const double incidence : {0.0, 0.3}) {
      const Beam beam({.incidence = incidence, .footprint = 0.5}, rays);
      ExpectEqual(TracePackets(RayBundle(beam, kN), surface.view()), SlowTwin(beam.Rays(0), surface.field()), rays,
                  0.15);
    }
  }
}

TEST_P(PacketTracer, OnAFlatSurfaceEqualsStillWaterExactly) {
  for (const double incidence : {0.0, 12.0, 25.0}) {
    const Beam beam({.incidence = incidence * kDegree, .azimuth = 0.5, .footprint = 0.5}, 1000);
    const TracedBundle traced = TracePackets(RayBundle(beam, kN), Plane({0, 0}).view());
    const RefractedRay still = RefractAtSlope(beam.Rays(0).front().direction, {0, 0}, kN);
    EXPECT_EQ(traced.beam.tangent, still.tangent);
    EXPECT_EQ(traced.beam.secant, still.secant);
    EXPECT_EQ(traced.beam.height_tangent, Eigen::Vector2d(0, 0));
    EXPECT_EQ(traced.beam.slope_squares, Eigen::Vector3d(0, 0, 0));
    EXPECT_EQ(traced.height, 0);
  }
}

TEST_P(PacketTracer, OnATiltedPlaneObeysSnellsLaw) {
  for (const Eigen::Vector2d& slope : {Eigen::Vector2d(0.1, 0), {-0.2, 0.3}, {0.003, -0.001}}) {
    for (const double incidence : {0.0, 0.2, 0.44}) {
      const Beam beam({.incidence = incidence, .azimuth = 1, .footprint = 0.5}, 1000);
      const Eigen::Vector3d direction = beam.Rays(0).front().direction;
      const RefractedRay still = RefractAtSlope(direction, {0, 0}, kN);
      const RefractedRay exact = RefractAtSlope(direction, slope, kN);
      const TracedBundle traced = TracePackets(RayBundle(beam, kN), Plane(slope).view());
      // A slope is the difference of two heights of up to a metre, over 1/16 m.
      const double tolerance = kSumRounding * slope.norm() + 2 * 16 * slope.norm() * 0x1p-24;
      EXPECT_LT((traced.beam.tangent - exact.tangent).norm(), tolerance);
      EXPECT_NEAR(traced.beam.secant - still.secant, exact.secant - still.secant, tolerance);
    }
  }
}

// TVU at nadir is the scatter of the secant, of the order of 0.03 times the mean square slope.
TEST_P(PacketTracer, ResolvesTheSmallDeparturesOfThePathAtNadir) {
  constexpr double kMeanSquareSlope = 0.002;
  const Surface surface = RoughWater(2, std::sqrt(kMeanSquareSlope / 2));
  const Beam beam({.footprint = 0.9}, 10000);
  const double fast = TracePackets(RayBundle(beam, kN), surface.view()).beam.secant - 1;
  const double slow = Trace(beam.Rays(0), surface.field(), kN).secant - 1;
  EXPECT_LT(slow, 0.05 * kMeanSquareSlope);
  EXPECT_NEAR(fast / slow, 1, kSumRounding + kNumberRounding * 8);
}

TEST_P(PacketTracer, LosesNoRayOnEdgesAndCorners) {
  constexpr double kPowerOfTwo = 1.0 / 32;  // puts the rays exactly on edges, also in single precision
  const Surface surface(RoughHeights(4, 0.1), kPoints, kPowerOfTwo);
  for (const double tangent : {0.0, 0.25}) {
    for (int twice_x = -20; twice_x <= 20; ++twice_x) {
      std::vector<Ray> rays;
      for (int twice_y = -20; twice_y <= 20; ++twice_y) {
        rays.push_back(
            {Eigen::Vector3d(tangent, 0, -1).normalized(), Eigen::Vector2d(twice_x, twice_y) * (kPowerOfTwo / 2)});
      }
      const TracedBundle traced = TracePackets(RayBundle(rays, kN), surface.view());
      EXPECT_NEAR(traced.height, SlowTwin(rays, surface.field()).height, kHeightTolerance);
    }
  }
}

// Facets that nearly turn away from the rays: steps fall short there, and packets do not converge.
TEST_P(PacketTracer, IntersectsUnsettledRaysOneByOne) {
  std::vector<double> ridges;
  for (int ix = 0; ix < kPoints; ++ix)
    for (int iy = 0; iy < kPoints; ++iy) ridges.push_back(ix % 4 < 2 ? ix % 4 * 0.55 : (4 - ix % 4) * 0.55);
  for (double& height : ridges) height *= kSpacing;
  const Surface surface(ridges, kPoints, kSpacing);
  const Beam beam({.incidence = 60 * kDegree, .footprint = 0.3}, 1000);
  const TracedBundle traced = TracePackets(RayBundle(beam, kN), surface.view());
  EXPECT_GT(traced.unsettled_rays, 0);
  const Twin twin = SlowTwin(beam.Rays(0), surface.field());
  EXPECT_NEAR(traced.height, twin.height, kHeightTolerance);
  EXPECT_LT((traced.beam.tangent - twin.beam.tangent).norm(), kSumRounding);
  const Beam gentle({.incidence = 20 * kDegree, .footprint = 0.3}, 1000);
  EXPECT_EQ(TracePackets(RayBundle(gentle, kN), RoughWater(1).view()).unsettled_rays, 0);
}

TEST_P(PacketTracer, ContinuesBeyondTheEdgesOnTheOutermostPlanes) {
  const Surface surface = Plane({0.3, -0.2}, 0.05);
  for (const double incidence : {0.0, 0.3}) {
    const Beam beam({.incidence = incidence, .azimuth = 1, .footprint = 4}, 1000);
    const TracedBundle traced = TracePackets(RayBundle(beam, kN), surface.view());
    EXPECT_NEAR(traced.height, SlowTwin(beam.Rays(0), surface.field()).height, kHeightTolerance);
  }
}

TEST_P(PacketTracer, ReadsRowsWithAStride) {
  const std::vector<double> heights = RoughHeights(7, 0.15);
  const Surface together(heights, kPoints, kSpacing), apart(heights, kPoints, kSpacing, 13);
  const RayBundle rays(Beam({.incidence = 0.3, .footprint = 0.9}, 1000), kN);
  EXPECT_EQ(TracePackets(rays, together.view()).beam.tangent, TracePackets(rays, apart.view()).beam.tangent);
}

TEST_P(PacketTracer, TracesTheSameBeamWithoutTheUnshiftedMeans) {
  const Surface surface = RoughWater(8);
  for (const double incidence : {0.0, 0.3}) {
    const RayBundle rays(Beam({.incidence = incidence, .footprint = 0.9}, 1000), kN);
    const TracedBeam with = TracePackets(rays, surface.view()).beam, without = Trace(rays, surface.view());
    EXPECT_LT((with.tangent - without.tangent).norm(), kSumRounding);
    EXPECT_NEAR(with.secant, without.secant, kSumRounding);
    EXPECT_LT((with.slope_squares - without.slope_squares).norm(), kSumRounding);
  }
}

TEST(RayBundle, HoldsEveryRayOnce) {
  const std::vector<Ray> rays = Beam({.incidence = 0.3, .azimuth = 1, .footprint = 1}, 1003).Rays(0);
  const RayBundle bundle(rays, kN);
  ASSERT_EQ(bundle.count(), 1003);
  std::vector<std::pair<float, float>> given, held;
  for (int j = 0; j < bundle.count(); ++j) {
    given.emplace_back(rays[j].at_zero.x(), rays[j].at_zero.y());
    held.emplace_back(bundle.x()[j], bundle.y()[j]);
  }
  std::sort(given.begin(), given.end());
  std::sort(held.begin(), held.end());
  EXPECT_EQ(given, held);
}

TEST(RayBundle, KeepsNeighboursTogether) {
  constexpr int kRays = 10000;
  const RayBundle bundle(Beam({.footprint = 1}, kRays), kN);
  const double distance = std::sqrt(0.7854 / kRays);  // between rays evenly spread over the footprint
  double sum = 0;
  for (int j = RayBundle::kStrips; j < kRays; ++j) {
    sum += std::hypot(bundle.x()[j] - bundle.x()[j - RayBundle::kStrips],
                      bundle.y()[j] - bundle.y()[j - RayBundle::kStrips]);
  }
  EXPECT_LT(sum / kRays, 3 * distance);
}

}  // namespace
}  // namespace albtpu
