#include "formats/crs/local_frame.h"

#include <gtest/gtest.h>

#include "tests/degree.h"

namespace albtpu::formats {
namespace {

using albtpu::testing::kDegree;

TEST(LocalFrame, TurnsEachAxisIntoMetresFromTheOrigin) {
  const LocalFrame frame = {
      .origin_x = 1000, .origin_y = 2000, .metres_per_x = 0.25, .metres_per_y = 0.5, .metres_per_z = 0.125};
  EXPECT_EQ(frame.At(1000, 2000, 0), Eigen::Vector3d::Zero());
  EXPECT_EQ(frame.At(1004, 1998, 16), Eigen::Vector3d(1, -1, 2));
}

TEST(LocalFrame, KeepsHeightsInTheirDatum) {
  const LocalFrame frame = {.origin_x = 1000, .origin_y = 2000};
  EXPECT_EQ(frame.Z(-23.5), -23.5);
}

// Near 180 degrees, longitudes of both signs, and those from 0 to 360, are one place.
TEST(LocalFrame, TakesLongitudesTheShortWayRound) {
  const auto map = *MapFrame::Create("in.las", {.user = "EPSG:4326"});
  const LocalFrame frame = *FrameAround({179.999, -16.8}, *map, 1);
  const double metres = map->MetricAt({-16.8 * kDegree, 0}).metres_per_x;
  for (const double x : {-179.999, 180.001}) EXPECT_NEAR(frame.At(x, -16.8).x(), 0.002 * metres, 1e-6) << x;
  EXPECT_NEAR(frame.MapOf(0.002 * metres, 0).x, 180.001, 1e-12);
}

// Cyprus in a projection of equal areas.
TEST(LocalFrame, HasPerpendicularAxesOnAnyMap) {
  const auto map = *MapFrame::Create("in.las", {.user = "EPSG:3035"});
  const GeographicPosition middle = {34.6 * kDegree, 33.1 * kDegree};
  const MapPosition origin = map->Project(middle);
  const LocalFrame frame = *FrameAround(origin, *map, 1);
  EXPECT_NEAR(std::atan2(frame.north_per_x, frame.metres_per_x) / kDegree, 2.40, 0.01);
  const double north = 100 / map->ellipsoid().MeridianRadius(middle.latitude);
  const MapPosition ahead = map->Project({middle.latitude + north, middle.longitude});
  const Eigen::Vector2d step = frame.At(ahead.x, ahead.y);
  EXPECT_NEAR(step.norm(), 100, 2e-3);  // (100 m / R) / 2 of it, by the second derivatives.
  EXPECT_NEAR(std::atan2(step.x(), step.y()) + frame.convergence, 0, 2e-5);
  const MapPosition back = frame.MapOf(step.x(), step.y());
  EXPECT_NEAR(back.x, ahead.x, 1e-8);
  EXPECT_NEAR(back.y, ahead.y, 1e-8);
}

}  // namespace
}  // namespace albtpu::formats
