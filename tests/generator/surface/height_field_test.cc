#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "generator/math/random_stream.h"
#include "generator/surface/ray_tracer.h"

namespace albtpu {
namespace {

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
