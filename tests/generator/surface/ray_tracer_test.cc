#include "generator/surface/ray_tracer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "generator/math/random_stream.h"
#include "generator/math/statistics.h"

namespace albtpu {
namespace {

constexpr double kN = kRefractiveIndex;
constexpr double kDegree = 0.017453292519943295;
constexpr double kRounding = 1e-13;  // of sums over a thousand rays

HeightField Plane(const Eigen::Vector2d& slope) {
  std::vector<double> heights;
  for (int ix = -1; ix <= 1; ++ix)
    for (int iy = -1; iy <= 1; ++iy) heights.push_back(slope.dot(Eigen::Vector2d(ix, iy)));
  return HeightField(heights, 3, 1.0);
}

HeightField RoughWater(std::uint32_t realization) {
  constexpr int kPoints = 31;
  std::vector<double> heights(kPoints * kPoints);
  NormalStream(5, 0, realization).Fill(heights);
  for (double& height : heights) height *= 0.005;
  return HeightField(heights, kPoints, 0.04);
}

// The centroid of the beam and the mean path at `depth` below the mean height of the intersections, ray by ray.
struct Spot {
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero(), mean_intersection = Eigen::Vector2d::Zero();
  double path = 0;
};
Spot SpotByHand(const std::vector<Ray>& rays, const HeightField& surface, double depth) {
  double mean_height = 0;
  for (const Ray& ray : rays) mean_height += Intersect(surface, ray).height / rays.size();
  Spot spot;
  for (const Ray& ray : rays) {
    const Hit hit = Intersect(surface, ray);
    const Eigen::Vector3d intersection =
        (Eigen::Vector3d() << ray.at_zero + hit.height * ray.per_height(), hit.height).finished();
    const Eigen::Vector3d refracted = Refract(ray.direction, NormalOfSlope(hit.facet.slope), kN);
    const double path = (mean_height - depth - intersection.z()) / refracted.z();
    spot.centroid += (intersection + path * refracted).head<2>() / rays.size();
    spot.mean_intersection += intersection.head<2>() / rays.size();
    spot.path += path / rays.size();
  }
  return spot;
}

TEST(TracedBeam, OnAFlatSurfaceIsRefractedAsByStillWater) {
  for (const double incidence : {0.0, 12.0, 25.0}) {
    const Beam beam({.incidence = incidence * kDegree, .azimuth = 0.5, .footprint = 0.5}, 1000);
    const TracedBeam traced = Trace(beam.Rays(0), Plane({0, 0}), kN);
    const double refracted = StillWaterRefraction(incidence * kDegree, kN);
    EXPECT_LT((traced.tangent - std::tan(refracted) * beam.azimuth_direction()).norm(), kRounding);
    EXPECT_NEAR(traced.secant, 1 / std::cos(refracted), kRounding);
    EXPECT_EQ(traced.height_tangent, Eigen::Vector2d(0, 0));
    EXPECT_EQ(traced.height_secant, 0);
    EXPECT_EQ(traced.slope, Eigen::Vector2d(0, 0));
  }
}

TEST(TracedBeam, OnFlatSurfacesHasNoUncertainty) {
  const Beam beam({.incidence = 0.3, .azimuth = 0.5, .footprint = 0.5}, 1000);
  Eigen::ArrayXd tangents(10), secants(10);
  for (int i = 0; i < 10; ++i) {
    const TracedBeam traced = Trace(beam.Rays(0), Plane({0, 0}), kN);
    tangents[i] = traced.tangent.x();
    secants[i] = traced.secant;
  }
  EXPECT_EQ(TwoSigma(tangents).value, 0);
  EXPECT_EQ(TwoSigma(secants).value, 0);
}

// A vertical beam on a plane that rises by alpha to +x: every ray leaves at alpha - asin(sin(alpha) / n) from the
// vertical, so its path from every height is d over the cosine of that angle.
TEST(TracedBeam, OnATiltedPlaneObeysSnellsLaw) {
  const double alpha = 10 * kDegree;
  const double deviation = alpha - std::asin(std::sin(alpha) / kN);
  const TracedBeam traced = Trace(Beam({.footprint = 0.5}, 500).Rays(0), Plane({std::tan(alpha), 0}), kN);
  EXPECT_NEAR(traced.tangent.x(), std::tan(deviation), kRounding);
  EXPECT_NEAR(traced.tangent.y(), 0, kRounding);
  constexpr double kDepth = 7;
  EXPECT_NEAR(traced.height_secant + kDepth * traced.secant, kDepth / std::cos(deviation), kRounding);
  EXPECT_NEAR(traced.height_tangent.norm(), 0, 1e-15);
}

// The plane falls by alpha to +x, so its normal leans to +x by alpha. A beam incident at theta towards +x arrives at
// theta + alpha from that normal.
TEST(TracedBeam, OnAPlaneTiltedInThePlaneOfIncidenceObeysSnellsLaw) {
  const double theta = 20 * kDegree, alpha = 6 * kDegree;
  const TracedBeam traced =
      Trace(Beam({.incidence = theta, .footprint = 0.5}, 500).Rays(0), Plane({-std::tan(alpha), 0}), kN);
  const double refracted = std::asin(std::sin(theta + alpha) / kN) - alpha;
  EXPECT_NEAR(traced.tangent.x(), std::tan(refracted), kRounding);
  EXPECT_NEAR(traced.secant, 1 / std::cos(refracted), kRounding);
}

TEST(TracedBeam, IsExactlyLinearInDepth) {
  const Beam beam({.incidence = 0.35, .azimuth = 0.8, .footprint = 0.6}, 300);
  const std::vector<Ray> rays = beam.Rays(0);
  for (std::uint32_t realization = 0; realization < 5; ++realization) {
    const HeightField surface = RoughWater(realization);
    const TracedBeam traced = Trace(rays, surface, kN);
    for (const double depth : {0.5, 3.0, 40.0}) {
      const Spot spot = SpotByHand(rays, surface, depth);
      const Eigen::Vector2d shift = traced.height_tangent + depth * traced.tangent;
      EXPECT_LT((spot.mean_intersection + shift - spot.centroid).norm(), 1e-12);
      EXPECT_NEAR(traced.height_secant + depth * traced.secant, spot.path, 1e-12);
    }
  }
}

TEST(TracedBeam, AddsTheUnresolvedWavesAtItsMeanSlope) {
  UnresolvedWaves unresolved;
  unresolved.offset << 1, 2, 3;
  unresolved.gain << 10, 0, 0, 20, 30, 40;
  TracedBeam beam = Trace(Beam({.footprint = 0.5}, 10).Rays(0), Plane({0.1, 0.2}), kN);
  const TracedBeam with = WithUnresolvedWaves(beam, unresolved);
  EXPECT_NEAR(with.tangent.x() - beam.tangent.x(), 1 + 10 * 0.1, kRounding);
  EXPECT_NEAR(with.tangent.y() - beam.tangent.y(), 2 + 20 * 0.2, kRounding);
  EXPECT_NEAR(with.secant - beam.secant, 3 + 30 * 0.1 + 40 * 0.2, kRounding);
  EXPECT_EQ(with.height_secant, beam.height_secant);
}

}  // namespace
}  // namespace albtpu
