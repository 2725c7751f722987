#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "generator/math/random_stream.h"
#include "generator/surface/ray_tracer.h"
#include "sea/response/closed_form.h"
#include "validation/laboratory/virtual_tank.h"

namespace albtpu {
namespace {

constexpr double kN = 1.33;
constexpr double kDepth = 0.25;  // m
const Eigen::Vector2d kOrigin(0, 0);

// The plane of slope (m, 0) through the origin.
HeightField TiltedPlane(double m) { return HeightField({-m, -m, -m, 0, 0, 0, m, m, m}, 3, 1.0); }
HeightField StillWater() { return TiltedPlane(0); }

// Vertical rays on a square lattice of pitch 1 mm, with the symmetry of the array.
std::vector<Ray> VerticalRays() {
  std::vector<Ray> rays;
  for (int i = -125; i < 125; ++i)
    for (int j = -125; j < 125; ++j) rays.push_back({{0, 0, -1}, {0.001 * (i + 0.5), 0.001 * (j + 0.5)}});
  return rays;
}

TEST(PhotodiodeArray, PutsASpotAtTheCentreOfItsPhotodiode) {
  const PhotodiodeArray array({}, {1, 2});
  EXPECT_EQ(array.Centroid({{1.027, 1.976}}).value(), Eigen::Vector2d(1.025, 1.975));
}

TEST(PhotodiodeArray, IsBlindBetweenAndBesideItsPhotodiodes) {
  const PhotodiodeArray array({}, kOrigin);
  EXPECT_FALSE(array.Centroid({{0, 0}, {0.031, 0.025}, {0.029, 0.029}, {0.175, 0.025}, {0.125, -0.131}}));
}

TEST(PhotodiodeArray, WeightsPhotodiodesByTheirLight) {
  const PhotodiodeArray array({}, kOrigin);
  const auto centroid = array.Centroid({{0.025, 0.025}, {0.024, 0.025}, {0.025, 0.026}, {-0.075, 0.025}});
  EXPECT_NEAR(centroid->x(), (3 * 0.025 - 0.075) / 4, 1e-15);
  EXPECT_NEAR(centroid->y(), 0.025, 1e-15);
}

TEST(PhotodiodeArray, HasTheCentroidOfASymmetricalBeamAtItsCentre) {
  const PhotodiodeArray array({}, kOrigin);
  const auto spots = SpotsAtDepth(VerticalRays(), StillWater(), kN, kDepth);
  EXPECT_LT(array.Centroid(spots)->norm(), 1e-15);
}

TEST(SpotsAtDepth, FollowSnellsLawThroughStillWater) {
  const Beam beam({.incidence = 0.3, .azimuth = 0.4, .footprint = 0.25, .source_height = 4}, 50);
  const std::vector<Ray> rays = beam.Rays(0);
  const auto spots = SpotsAtDepth(rays, StillWater(), kN, kDepth);
  for (std::size_t r = 0; r < rays.size(); ++r) {
    const Eigen::Vector2d across = rays[r].direction.head<2>();  // its length is the sine of the incidence
    const double tangent = std::tan(std::asin(across.norm() / kN));
    EXPECT_LT((spots[r] - rays[r].at_zero - kDepth * tangent * across.normalized()).norm(), 1e-15);
  }
}

// Vertical light meets a plane of slope m at alpha = atan(m) and leaves it at alpha - asin(sin(alpha) / n) from the
// vertical, towards the higher water.
TEST(SpotsAtDepth, FollowTheClosedFormUnderATiltedPlane) {
  const double m = 0.2, alpha = std::atan(m);
  const double tangent = std::tan(alpha - std::asin(std::sin(alpha) / kN));
  const std::vector<Ray> rays = VerticalRays();
  const auto spots = SpotsAtDepth(rays, TiltedPlane(m), kN, kDepth);
  for (std::size_t r = 0; r < rays.size(); r += 997) {
    const Eigen::Vector2d& x = rays[r].at_zero;
    EXPECT_NEAR(spots[r].x(), x.x() + (kDepth + m * x.x()) * tangent, 1e-15);
    EXPECT_NEAR(spots[r].y(), x.y(), 1e-15);
  }
}

TEST(PhotodiodeArray, FollowsABeamIfItsPhotodiodesLeaveNoGaps) {
  const double m = 0.16, alpha = std::atan(m);
  const double tangent = std::tan(alpha - std::asin(std::sin(alpha) / kN));
  const auto spots = SpotsAtDepth(VerticalRays(), TiltedPlane(m), kN, kDepth);
  const PhotodiodeArray dense({.per_side = 300, .pitch = 0.001, .aperture = 0.001}, kOrigin);
  // The mean of x + (d + m x) t over a beam that is symmetrical in x. A spot is located to half a pitch.
  EXPECT_NEAR(dense.Centroid(spots)->x(), kDepth * tangent, 0.0005);
  EXPECT_NEAR(dense.Centroid(spots)->y(), 0, 1e-12);
}

TEST(SpotsAtDepth, HaveTheCentroidOfTheTracedBeam) {
  constexpr int kPoints = 101;
  std::vector<double> heights(kPoints * kPoints);
  NormalStream(1, 0, 0).Fill(heights);
  for (double& height : heights) height *= 1e-3;
  const HeightField water(std::move(heights), kPoints, 0.005);
  const std::vector<Ray> rays = Beam({.footprint = 0.25}, 2000).Rays(0);  // vertical

  const TracedBeam traced = Trace(rays, water, kN);
  Eigen::Vector2d met = kOrigin, centroid = kOrigin;
  double height = 0;
  const auto spots = SpotsAtDepth(rays, water, kN, kDepth);
  for (std::size_t r = 0; r < rays.size(); ++r) {
    met += rays[r].at_zero / static_cast<double>(rays.size());
    height += Intersect(water, rays[r]).height / static_cast<double>(rays.size());
    centroid += spots[r] / static_cast<double>(rays.size());
  }
  // The tracer measures depth from the mean height of the intersections.
  const Eigen::Vector2d expected = met + (kDepth + height) * traced.tangent + traced.height_tangent;
  EXPECT_LT((centroid - expected).norm(), 1e-14);
  EXPECT_GT((expected - met).norm(), 1e-5);
}

}  // namespace
}  // namespace albtpu
