#include "annotate/beams/file_track.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/budget/beams/ray_flight.h"
#include "tests/formats/trajectories/flight_files.h"

namespace albtpu::annotate {
namespace {

using namespace albtpu::testing;  // SimulatedFlight, kDegree.
using ::testing::ElementsAre;
using ::testing::HasSubstr;

absl::StatusOr<FileTrack> FromReturns(const TrackedFile& file) { return TrackFromReturns(file, kSeaWaterIndex); }

// Rays of a straight flight without errors, 400 m above the water at 60 m/s.
TrackedFile FlownFile(double pairs_per_second) {
  const SimulatedFlight flight({.duration = 20, .pairs_per_second = pairs_per_second, .point_noise = 0, .drift = 0});
  TrackedFile file;
  file.name = "in.las";
  file.rays = RaysOf(flight.Rays());
  file.pairs = 2 * file.rays.size();
  return file;
}

TEST(TrackFromReturns, StatesWhatItFound) {
  const TrackedFile file = FlownFile(500);
  const absl::StatusOr<FileTrack> found = FromReturns(file);
  EXPECT_EQ((*found->json)["pairs"], file.pairs);
  EXPECT_EQ((*found->json)["rays"], file.rays.size());
  EXPECT_EQ((*found->json)["segments"], 1);
  // Rays without errors meet at the sensor: what is left is rounding, and the floor of the noise in the fit.
  EXPECT_NEAR((*found->json)["height_above_water"].get<double>(), 400, 0.003);
  EXPECT_NEAR((*found->json)["speed"].get<double>(), 60, 0.003);
  EXPECT_LT((*found->json)["incidence_sigma"].get<double>(), 0.3);
}

TEST(TrackFromReturns, SaysThatDirectionsAreFromGridNorthWithoutAMap) {
  TrackedFile file = FlownFile(100);
  absl::StatusOr<FileTrack> found = FromReturns(file);
  EXPECT_THAT(found->notes, ElementsAre(HasSubstr("trajectory from "), HasSubstr("directions are from grid north")));
  const auto map = formats::MapFrame::Create("in.las", {.user = "EPSG:32617"});
  file.map = *map;
  file.frame = *formats::FrameAround({400000, 3e6}, **map, 1);
  found = FromReturns(file);
  EXPECT_THAT(found->notes, ElementsAre(HasSubstr("trajectory from ")));
  const auto [positions, outcomes] = Ask(*found->track, {1010});
  EXPECT_EQ(outcomes[0], TrackOutcome::kKnown);
  EXPECT_LT(positions[0].convergence,
            -0.4 * kDegree);  // West of the central meridian: 1 degree x sin(27 degrees).
}

TEST(TrackFromReturns, TakesTimesInMilliseconds) {
  const TrackedFile seconds = FlownFile(500);
  TrackedFile milliseconds = seconds;
  for (AirRay& ray : milliseconds.rays) ray.time *= 1000;
  const absl::StatusOr<FileTrack> right = FromReturns(seconds);
  const absl::StatusOr<FileTrack> found = TrackFromReturns(milliseconds, kSeaWaterIndex, 1e-3);
  ASSERT_TRUE(found.ok()) << found.status();
  EXPECT_NEAR((*found->json)["speed"].get<double>(), 60, 0.003);
  const auto [expected, known] = Ask(*right->track, {1010});
  const auto [positions, outcomes] = Ask(*found->track, {1010e3});
  EXPECT_EQ(outcomes[0], TrackOutcome::kKnown);
  EXPECT_NEAR(positions[0].x, expected[0].x, 1e-5);
  EXPECT_NEAR(positions[0].z, expected[0].z, 1e-5);
  EXPECT_NEAR(found->motions->At(1010e3)->velocity[0], right->motions->At(1010)->velocity[0], 1e-5);
}

TEST(TrackFromReturns, RefusesAFileWithoutRays) {
  TrackedFile file;
  file.name = "in.las";
  file.pairs = 7;
  const std::string refusal(FromReturns(file).status().message());
  EXPECT_THAT(refusal, HasSubstr("in.las: the position of the sensor cannot be derived from its returns (7 pairs"));
  EXPECT_THAT(refusal, HasSubstr("or give a trajectory by --trajectory"));
}

TEST(TrackFromReturns, RefusesTooFewRays) {
  TrackedFile file = FlownFile(500);
  file.rays.resize(10);
  EXPECT_THAT(std::string(FromReturns(file).status().message()),
              HasSubstr("(10 pulses with two returns under water are too few"));
}

}  // namespace
}  // namespace albtpu::annotate
