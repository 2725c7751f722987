#include "generator/surface/ray_tracer.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "generator/math/random_stream.h"
#include "generator/math/statistics.h"
#include "tests/degree.h"

namespace albtpu {
namespace {

constexpr double kN = kRefractiveIndex;
using albtpu::testing::kDegree;
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
  unresolved.curvature << 100, 0, 0, 0, 200, 0, 300, 400, 500;
  TracedBeam beam = Trace(Beam({.footprint = 0.5}, 10).Rays(0), Plane({0.1, 0.2}), kN);
  const TracedBeam with = WithUnresolvedWaves(beam, unresolved);
  EXPECT_NEAR(with.tangent.x() - beam.tangent.x(), 1 + 10 * 0.1 + 100 * 0.01, kRounding);
  EXPECT_NEAR(with.tangent.y() - beam.tangent.y(), 2 + 20 * 0.2 + 200 * 0.04, kRounding);
  EXPECT_NEAR(with.secant - beam.secant, 3 + 30 * 0.1 + 40 * 0.2 + 300 * 0.01 + 400 * 0.04 + 500 * 0.02, kRounding);
  EXPECT_EQ(with.height_secant, beam.height_secant);
}

constexpr int kPoints = 11;
constexpr double kSpacing = 0.1;
constexpr double kReach = 0.5;

// Heights with a standard deviation of a tenth of the spacing.
std::vector<double> RandomHeights(std::uint32_t realization) {
  std::vector<double> heights(kPoints * kPoints);
  NormalStream(3, 0, realization).Fill(heights);
  for (double& height : heights) height *= 0.1 * kSpacing;
  return heights;
}

Eigen::Vector3d PointOf(const std::vector<double>& heights, int ix, int iy) {
  return {ix * kSpacing - kReach, iy * kSpacing - kReach, heights[ix * kPoints + iy]};
}

// The height at which a ray intersects one triangle, by solving for the barycentric coordinates. Edges belong to the
// triangle.
std::optional<double> HeightOnTriangle(const Ray& ray, const std::array<Eigen::Vector3d, 3>& triangle) {
  Eigen::Matrix3d system;
  system << triangle[1] - triangle[0], triangle[2] - triangle[0], -ray.direction;
  const Eigen::Vector3d origin(ray.at_zero.x(), ray.at_zero.y(), 0);
  const Eigen::Vector3d at = system.inverse() * (origin - triangle[0]);
  constexpr double kEdge = 1e-9;
  if (at.x() < -kEdge || at.y() < -kEdge || at.x() + at.y() > 1 + kEdge) return std::nullopt;
  return at.z() * ray.direction.z();
}

// The slow, obvious twin of Intersect: tries every triangle and returns all intersections, in no order.
std::vector<double> HeightsOnAllTriangles(const Ray& ray, const std::vector<double>& heights) {
  std::vector<double> intersections;
  for (int ix = 0; ix + 1 < kPoints; ++ix) {
    for (int iy = 0; iy + 1 < kPoints; ++iy) {
      const Eigen::Vector3d low = PointOf(heights, ix, iy), high = PointOf(heights, ix + 1, iy + 1);
      for (const Eigen::Vector3d& third : {PointOf(heights, ix + 1, iy), PointOf(heights, ix, iy + 1)})
        if (const auto height = HeightOnTriangle(ray, {low, third, high})) intersections.push_back(*height);
    }
  }
  return intersections;
}

Ray RayThrough(const Eigen::Vector3d& point, double incidence, double azimuth) {
  Ray ray;
  ray.direction << std::sin(incidence) * std::cos(azimuth), std::sin(incidence) * std::sin(azimuth),
      -std::cos(incidence);
  ray.at_zero = point.head<2>() - point.z() * ray.per_height();
  return ray;
}

TEST(HeightField, DividesEachCellAlongTheDiagonalFromItsLowToItsHighCorner) {
  // The cell from (0, 0) to (1, 1) has the corners 1 (low), 2 (along x), 5 (along y) and 9 (high).
  const HeightField surface({0, 0, 0, 0, 1, 5, 0, 2, 9}, 3, 1.0);
  const HeightField::Facet beside_x = surface.FacetAt({0.7, 0.2});
  EXPECT_EQ(beside_x.slope, Eigen::Vector2d(1, 7));
  EXPECT_DOUBLE_EQ(beside_x.HeightAt({0.7, 0.2}), 1 + 0.7 * 1 + 0.2 * 7);
  const HeightField::Facet beside_y = surface.FacetAt({0.2, 0.7});
  EXPECT_EQ(beside_y.slope, Eigen::Vector2d(4, 4));
  EXPECT_DOUBLE_EQ(beside_y.HeightAt({0.2, 0.7}), 1 + 0.2 * 4 + 0.7 * 4);
  EXPECT_DOUBLE_EQ(beside_x.HeightAt({0.5, 0.5}), beside_y.HeightAt({0.5, 0.5}));
}

TEST(Intersection, EqualsTheSearchOverAllTriangles) {
  const std::vector<Eigen::Vector2d> spots = {{0.013, 0.021}, {-0.31, 0.17}, {0.402, -0.377}, {-0.05, -0.44}};
  for (std::uint32_t realization = 0; realization < 50; ++realization) {
    const std::vector<double> heights = RandomHeights(realization);
    const HeightField surface(heights, kPoints, kSpacing);
    for (const double incidence : {0.0, 0.35, 0.44, 0.8}) {
      for (const Eigen::Vector2d& spot : spots) {
        const Ray ray = RayThrough({spot.x(), spot.y(), 0}, incidence, 2.0 + realization);
        const std::vector<double> expected = HeightsOnAllTriangles(ray, heights);
        ASSERT_FALSE(expected.empty());
        for (const double height : expected) EXPECT_NEAR(Intersect(surface, ray).height, height, 1e-12);
      }
    }
  }
}

TEST(Intersection, IsFoundOnEdgesAndCorners) {
  const std::vector<double> heights = RandomHeights(1);
  const HeightField surface(heights, kPoints, kSpacing);
  for (int ix = 0; ix + 1 < kPoints; ++ix) {
    for (int iy = 0; iy + 1 < kPoints; ++iy) {
      const Eigen::Vector3d corner = PointOf(heights, ix, iy);
      for (const Eigen::Vector3d& target : {corner, Eigen::Vector3d((corner + PointOf(heights, ix + 1, iy)) / 2),
                                            Eigen::Vector3d((corner + PointOf(heights, ix, iy + 1)) / 2),
                                            Eigen::Vector3d((corner + PointOf(heights, ix + 1, iy + 1)) / 2)})
        for (const double incidence : {0.0, 0.35, 0.8})
          EXPECT_NEAR(Intersect(surface, RayThrough(target, incidence, 0.6)).height, target.z(), 1e-12);
    }
  }
}

TEST(Intersection, LiesOnItsFacet) {
  const HeightField surface(RandomHeights(2), kPoints, kSpacing);
  for (double x = -0.3; x < 0.3; x += 0.0137) {
    const Ray ray = RayThrough({x, 0.1, 0}, 0.4, 1.0);
    const Hit hit = Intersect(surface, ray);
    EXPECT_NEAR(hit.facet.HeightAt(ray.at_zero + hit.height * ray.per_height()), hit.height, 1e-12);
  }
}

TEST(Intersection, BeyondTheEdgesLiesOnTheOutermostPlanes) {
  const Eigen::Vector2d slope(0.3, -0.2);
  std::vector<double> heights(kPoints * kPoints);
  for (int ix = 0; ix < kPoints; ++ix) {
    for (int iy = 0; iy < kPoints; ++iy) {
      heights[ix * kPoints + iy] =
          0.05 + slope.dot(Eigen::Vector2d(ix, iy) * kSpacing - Eigen::Vector2d(kReach, kReach));
    }
  }
  const HeightField plane(heights, kPoints, kSpacing);
  for (const Eigen::Vector2d& spot : {Eigen::Vector2d(3, 0), {-3, 2}, {0.1, -7}, {20, 20}}) {
    const Eigen::Vector3d target(spot.x(), spot.y(), 0.05 + slope.dot(spot));
    for (const double incidence : {0.0, 0.44})
      EXPECT_NEAR(Intersect(plane, RayThrough(target, incidence, 0.3)).height, target.z(), 1e-11);
  }
}

}  // namespace
}  // namespace albtpu
