#include "survey/las/beam_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tables/axis.h"

namespace albtpu::client {
namespace {

// The pulse of a single point.
Pulse At(const FlightLine& line, double z, double scan_angle) {
  PulseBatch pulses;
  line.MakePulses({&z, 1}, {&scan_angle, 1}, pulses);
  return PulseAt(pulses.columns(), 0);
}

TEST(BeamGeometry, FootprintGrowsWithDistance) {
  EXPECT_DOUBLE_EQ(FootprintDiameter(400, 1, 0), 0.4);
  EXPECT_NEAR(FootprintDiameter(400, 1, 60), 0.8, 1e-12);  // Twice as far.
  EXPECT_DOUBLE_EQ(FootprintDiameter(400, 2.5, 0), 1.0);
}

TEST(BeamGeometry, PointsDownwindWhenTheWindBlowsToTheRight) {
  // Flying north with wind from the west: the wind blows to the east, where the beam points at positive scan angles.
  EXPECT_EQ(FoldAzimuth(AcrossTrackAzimuth(0, 270, 15)), 0);
  EXPECT_EQ(std::remainder(AcrossTrackAzimuth(0, 270, 15), 360), 0);
  EXPECT_EQ(std::abs(std::remainder(AcrossTrackAzimuth(0, 270, -15), 360)), 180);
}

TEST(BeamGeometry, PointsCrosswindWhenTheWindBlowsAlongTheFlight) {
  EXPECT_EQ(FoldAzimuth(AcrossTrackAzimuth(37, 37, 15)), 90);
  EXPECT_EQ(FoldAzimuth(AcrossTrackAzimuth(37, 217, -15)), 90);
}

TEST(BeamGeometry, FollowsTheDefinition) {
  EXPECT_EQ(AcrossTrackAzimuth(30, 10, 5), (30 + 90) - (10 + 180));
  EXPECT_EQ(AcrossTrackAzimuth(30, 10, -5), (30 - 90) - (10 + 180));
}

TEST(BeamGeometry, HasTheSameFoldedAzimuthOnBothSides) {
  for (const double angle : {-20.0, 0.0, 20.0}) EXPECT_EQ(FoldAzimuth(AcrossTrackAzimuth(20, 95, angle)), 15);
}

TEST(BeamGeometry, MakesThePulseOfAPoint) {
  FlightLine line;
  line.water_level = -23.09;
  line.wind_speed = 6;
  line.footprint = DivergingBeam{.altitude = 400, .divergence = 1};
  line.azimuth = AcrossTrackScan{.flight_direction = 30, .wind_from = 10};
  const Pulse pulse = At(line, -25.5, -12.006);
  EXPECT_EQ(pulse.wind_speed, 6);
  EXPECT_TRUE(std::isinf(pulse.fetch));
  EXPECT_EQ(pulse.incidence, 12.006f);
  EXPECT_EQ(pulse.azimuth, -250.0f);
  EXPECT_EQ(pulse.depth, static_cast<float>(-23.09 - -25.5));
  EXPECT_NEAR(pulse.footprint, 0.4 / std::cos(12.006 * M_PI / 180), 1e-6);
}

TEST(BeamGeometry, ConvertsOnlyDepthFromFeet) {
  FlightLine line;
  line.water_level = 10;
  line.metres_per_unit = 0.3048;
  line.footprint = 0.5f;
  line.azimuth = 45.0f;
  const Pulse pulse = At(line, 0, 3);
  EXPECT_EQ(pulse.depth, 3.048f);
  EXPECT_EQ(pulse.footprint, 0.5f);
  EXPECT_EQ(pulse.azimuth, 45.0f);
}

TEST(BeamGeometry, PointsAboveTheWaterHaveNegativeDepth) {
  FlightLine line;
  line.water_level = 1;
  EXPECT_LT(At(line, 2, 0).depth, 0);
  EXPECT_FALSE(At(line, 2, 0).azimuth.has_value());
}

TEST(BeamGeometry, StoresOneNumberWhereAllPulsesHaveTheSame) {
  FlightLine line;
  line.wind_speed = 6;
  line.footprint = 0.5f;
  const std::vector<double> z = {-1, -2, -3}, scan_angles = {-5, 0, 5};
  PulseBatch pulses;
  line.MakePulses(z, scan_angles, pulses);
  EXPECT_TRUE(CheckLengths(pulses.columns()).ok());
  EXPECT_EQ(pulses.size, 3u);
  EXPECT_EQ(pulses[AxisId::kWindSpeed], std::vector<float>{6});
  EXPECT_EQ(pulses[AxisId::kFootprint], std::vector<float>{0.5});
  EXPECT_TRUE(pulses[AxisId::kFetch].empty());
  EXPECT_TRUE(pulses[AxisId::kAzimuth].empty());
  EXPECT_EQ(pulses[AxisId::kDepth], (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(pulses[AxisId::kIncidence], (std::vector<float>{5, 0, 5}));
}

}  // namespace
}  // namespace albtpu::client
