#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "annotate/beams/file_track.h"
#include "tests/budget/beams/ray_flight.h"
#include "tests/degree.h"

namespace albtpu::annotate {
namespace {

using testing::Ask;
using testing::TrackAnswer;

using albtpu::testing::kDegree;
constexpr double kEarthRadius = 6.36e6;  // m, rounded down.

std::shared_ptr<const formats::MapFrame> Map(const std::string& crs) {
  auto map = formats::MapFrame::Create("in.las", {.user = crs});
  return *map;
}

// The frame around a position, as that of a file is made.
formats::LocalFrame FrameAt(const formats::MapFrame& map, double latitude, double longitude) {
  return *formats::FrameAround(map.Project({latitude * kDegree, longitude * kDegree}), map, 1);
}

// A track of 15 s that begins at (east, north) [m] of the local frame.
RayTrack TrackAt(double east, double north) {
  const testing::SimulatedFlight flight({.duration = 15, .point_noise = 0});
  std::vector<AirRay> rays = testing::RaysOf(flight.Rays());
  for (AirRay& ray : rays) ray.water_point += Eigen::Vector3d(east, north, 0);
  return FitTrack(rays);
}

// Every position is that of the track of the rays, in the unit of the file.
void ExpectPositionsInUnitsOf(const formats::LocalFrame& frame) {
  const FittedTrack track(TrackAt(300, -200), frame);
  const std::vector<double> times = {1001, 1005, 1014};
  const TrackAnswer local = Ask(track.track(), times), answer = Ask(track, times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    ASSERT_EQ(answer.outcomes[i], TrackOutcome::kKnown);
    const SensorPosition& position = answer.positions[i];
    // Two roundings of a coordinate of the size of the origin, in metres.
    const double rounding =
        1e-15 * std::max(std::abs(frame.origin_x) * frame.metres_per_x, std::abs(frame.origin_y) * frame.metres_per_y);
    const Eigen::Vector2d at = frame.At(position.x, position.y);
    EXPECT_NEAR(at.x(), local.positions[i].x, rounding);
    EXPECT_NEAR(at.y(), local.positions[i].y, rounding);
    EXPECT_EQ(position.z, local.positions[i].z);  // Metres.
    EXPECT_EQ(position.metres_per_x, frame.metres_per_x);
    EXPECT_EQ(position.metres_per_y, frame.metres_per_y);
    EXPECT_EQ(position.incidence_sigma, local.positions[i].incidence_sigma);
  }
}

TEST(FittedTrack, HasThePositionsOfTheFileInMetresFeetAndDegrees) {
  for (const char* crs : {"EPSG:32617", "EPSG:2236", "EPSG:5070", "EPSG:4269"}) {
    SCOPED_TRACE(crs);
    const auto map = Map(crs);
    ExpectPositionsInUnitsOf(FrameAt(*map, 26, -80.4));
  }
}

TEST(FittedTrack, TakesGridNorthForTrueNorthWithoutAMap) {
  const formats::LocalFrame frame = {.origin_x = 500000, .origin_y = 3e6};
  ExpectPositionsInUnitsOf(frame);
  const FittedTrack track(TrackAt(0, 0), frame);
  EXPECT_EQ(Ask(track, {1005}).positions[0].convergence, 0);
}

// The convergence w sin(latitude), w the difference of longitude, has the mixed second derivative sec^2(latitude) / R^2
// in metres east and north; the derivatives in one direction are smaller by w. So the slope leaves
// east x north sec^2 / R^2, and little more.
TEST(FittedTrack, HasAConvergenceThatIsLinearOverTheFile) {
  for (const char* crs : {"EPSG:32617", "EPSG:2236"}) {
    const auto map = Map(crs);
    const formats::LocalFrame frame = FrameAt(*map, 26, -80.4);
    for (const double distance : {0.0, 10600.0}) {  // Of the track from the origin, in each direction.
      const FittedTrack track(TrackAt(distance, distance), frame);
      const SensorPosition position = Ask(track, {1005}).positions[0];
      const std::optional<formats::GeographicPosition> at = map->GeographicAt({position.x, position.y});
      ASSERT_TRUE(at.has_value());
      const Eigen::Vector2d from_origin = frame.At(position.x, position.y);
      const double mixed =
          std::abs(from_origin.x() * from_origin.y()) / std::pow(kEarthRadius * std::cos(26.2 * kDegree), 2);
      // The other second derivatives, of w tan(latitude) sec^2(latitude) and less, over both axes; the differences
      // over 1 km leave 1 km x 15 km of the same, and MetricAt is right to 1e-9.
      const double rest =
          1.5e4 * (1.5e4 + 1e3) / std::pow(kEarthRadius, 2) * (1.5 * kDegree) + 1e3 * 1.5e4 / std::pow(kEarthRadius, 2);
      EXPECT_NEAR(position.convergence, map->MetricAt(*at).convergence, 1.05 * mixed + (distance > 0 ? rest : 1e-7))
          << crs;
      if (distance > 0) {
        EXPECT_GT(
            std::abs(position.convergence - Ask(FittedTrack(TrackAt(0, 0), frame), {1005}).positions[0].convergence),
            5e-4);  // 10.6 km tan(26 degrees) / R = 8e-4: much more than the tolerance.
      }
    }
  }
}

TEST(FittedTrack, HasNoConvergenceInGeographicCoordinates) {
  const auto map = Map("EPSG:4269");
  const FittedTrack track(TrackAt(0, 0), FrameAt(*map, 26, -80.4));
  EXPECT_EQ(Ask(track, {1005}).positions[0].convergence, 0);
}

TEST(FittedTrack, IsNotExtrapolated) {
  const auto map = Map("EPSG:32617");
  const FittedTrack track(TrackAt(0, 0), FrameAt(*map, 26, -80.4));
  EXPECT_EQ(Ask(track, {990, 1005, 1020}).outcomes,
            (std::vector<TrackOutcome>{TrackOutcome::kOutside, TrackOutcome::kKnown, TrackOutcome::kOutside}));
}

}  // namespace
}  // namespace albtpu::annotate
