#include "annotate/beams/point_beams.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tables/axis.h"
#include "tests/degree.h"

namespace albtpu::annotate {
namespace {

using albtpu::testing::kDegree;

// Points of these heights and scan angles at x = y = 0.
SurveyPoints PointsOf(std::vector<double> z, std::vector<double> scan_angles) {
  SurveyPoints points;
  points.x.assign(z.size(), 0);
  points.y.assign(z.size(), 0);
  points.times.assign(z.size(), 1);
  points.z = std::move(z);
  points.scan_angles = std::move(scan_angles);
  return points;
}

PointBeams BeamsOf(const BeamPlan& plan, const SurveyPoints& points, const SensorTrack* track = nullptr) {
  formats::LocalFrame frame;
  frame.metres_per_z = plan.metres_per_unit.value_or(1);
  BeamScratch scratch;
  PointBeams beams;
  BeamGeometry(plan, frame, {.surface = nullptr, .levels = nullptr, .level = plan.water_level}, track)
      .Compute(points, scratch, beams);
  return beams;
}

PulseBatch PulsesOf(const BeamPlan& plan, const PointBeams& beams) {
  std::vector<std::uint32_t> rows;
  PulseBatch pulses;
  MakePulses(plan, beams, rows, pulses);
  EXPECT_TRUE(CheckLengths(pulses.columns()).ok());
  return pulses;
}

Pulse PulseOf(const BeamPlan& plan, double z, double scan_angle) {
  return PulseAt(PulsesOf(plan, BeamsOf(plan, PointsOf({z}, {scan_angle}))).columns(), 0);
}

BeamPlan AcrossTrack(AcrossTrackScan scan = {}) {
  BeamPlan plan;
  plan.source = scan;
  plan.water_level = 0;
  plan.footprint = 0.5f;
  return plan;
}

TEST(PointBeams, PointsDownwindWhenTheWindBlowsToTheRight) {
  // Flying north with wind from the west: the wind blows to the east, where the beam points at positive scan angles.
  BeamPlan plan = AcrossTrack({.flight_direction = 0, .altitude = {}});
  plan.wind_from = 270;
  EXPECT_EQ(std::remainder(*PulseOf(plan, -1, 15).azimuth, 360), 0);
  EXPECT_EQ(std::abs(std::remainder(*PulseOf(plan, -1, -15).azimuth, 360)), 180);
}

TEST(PointBeams, PointsCrosswindWhenTheWindBlowsAlongTheFlight) {
  BeamPlan plan = AcrossTrack({.flight_direction = 37, .altitude = {}});
  plan.wind_from = 217;
  EXPECT_EQ(FoldAzimuth(*PulseOf(plan, -1, -15).azimuth), 90);
}

// The covariance of a total is on the axes of the file, whether the beams come from a track or not.
TEST(PointBeams, KnowTheConvergenceOfTheirGridWithoutATrack) {
  BeamPlan plan = AcrossTrack({.flight_direction = 0, .altitude = 400});
  plan.any_aircraft = true;
  const formats::LocalFrame frame = {
      .origin_x = 10, .metres_per_x = 2, .convergence = 0.02, .convergence_slope = {1e-4, 1e-5}};
  SurveyPoints points = PointsOf({-1, -1}, {15, 15});
  points.x = {10, 110};
  points.y = {0, 1000};
  BeamScratch scratch;
  PointBeams beams;
  BeamGeometry(plan, frame, {.surface = nullptr, .levels = nullptr, .level = 0}, nullptr)
      .Compute(points, scratch, beams);
  EXPECT_FLOAT_EQ(beams.convergence[0], 0.02F);
  EXPECT_FLOAT_EQ(beams.convergence[1], 0.02F + 200 * 1e-4F + 1000 * 1e-5F);
}

TEST(PointBeams, OfAnAcrossTrackScannerHaveTheScanAngleForIncidence) {
  BeamPlan plan = AcrossTrack({.flight_direction = 30, .altitude = 400});
  plan.wind_speed = 6;
  plan.water_level = -23.09;
  plan.wind_from = 10;
  plan.footprint = DivergingBeam{.divergence = 1};
  const Pulse pulse = PulseOf(plan, -25.5, -12.006);
  EXPECT_EQ(pulse.wind_speed, 6);
  EXPECT_TRUE(std::isinf(pulse.fetch));
  EXPECT_EQ(pulse.incidence, 12.006f);
  EXPECT_EQ(pulse.azimuth, -250.0f);
  EXPECT_EQ(pulse.depth, static_cast<float>(-23.09 - -25.5));
  EXPECT_NEAR(pulse.footprint, 0.4 / std::cos(12.006 * kDegree), 1e-6);
  const PointBeams beams = BeamsOf(plan, PointsOf({-25.5}, {-12.006}));
  EXPECT_EQ(beams.beam_azimuth[0], 300);  // To the left of 30 degrees.
  EXPECT_NEAR(beams.slant_range[0], 400 / std::cos(12.006 * kDegree), 1e-4);
}

TEST(PointBeams, OfAConeHaveOneIncidence) {
  BeamPlan plan = AcrossTrack();
  plan.source = ConstantIncidence{.incidence = 60, .beam_azimuth = 370, .altitude = 200};
  plan.footprint = DivergingBeam{.divergence = 1, .aperture = 0.25};
  const PointBeams beams = BeamsOf(plan, PointsOf({-1, -2}, {3, -9}));
  EXPECT_EQ(beams.incidence, (std::vector<float>{60, 60}));
  EXPECT_EQ(beams.beam_azimuth, (std::vector<float>{10, 10}));
  EXPECT_NEAR(beams.slant_range[0], 400, 1e-4);  // Twice as far as at the nadir.
  EXPECT_NEAR(beams.footprint[1], 0.65, 1e-6);
}

TEST(PointBeams, AreNotKnownOfPointsThatAreNoLowerThanTheSensor) {
  BeamPlan plan = AcrossTrack();
  plan.source = ConstantIncidence{.incidence = 60, .beam_azimuth = 10, .altitude = 200};
  plan.footprint = DivergingBeam{.divergence = 1, .aperture = 0.25};
  plan.dry_points = true;
  for (const auto& [z, known] : {std::pair(198, true), std::pair(500, false)}) {
    const PointBeams beams = BeamsOf(plan, PointsOf({static_cast<double>(z)}, {0}));
    EXPECT_EQ(std::isfinite(beams.incidence[0]), known);
    EXPECT_EQ(std::isfinite(beams.slant_range[0]), known);
    EXPECT_EQ(std::isfinite(beams.footprint[0]), known);
  }
}

TEST(PointBeams, ConvertOnlyHeightsFromFeet) {
  BeamPlan plan = AcrossTrack();
  plan.water_level = 10;
  plan.metres_per_unit = 0.3048;
  plan.azimuth = 45.0f;
  const Pulse pulse = PulseOf(plan, 0, 3);
  EXPECT_EQ(pulse.depth, 3.048f);
  EXPECT_EQ(pulse.footprint, 0.5f);
  EXPECT_EQ(pulse.azimuth, 45.0f);
}

TEST(PointBeams, ExistAboveTheWaterButHaveNoPulse) {
  const BeamPlan plan = AcrossTrack();
  const PointBeams beams = BeamsOf(plan, PointsOf({2, -1}, {0, 5}));
  EXPECT_EQ(beams.why_not[0], NoPulse::kAboveWater);
  EXPECT_EQ(beams.depth[0], -2);
  EXPECT_FALSE(beams.why_not[1].has_value());
  EXPECT_EQ(PulsesOf(plan, beams)[AxisId::kDepth], std::vector<float>{1});
}

TEST(PointBeams, NeedAWaterSurface) {
  BeamPlan plan = AcrossTrack();
  plan.water_level.reset();
  const PointBeams beams = BeamsOf(plan, PointsOf({-1}, {0}));
  EXPECT_EQ(beams.why_not[0], NoPulse::kNoSurface);
  EXPECT_TRUE(std::isnan(beams.depth[0]));
  EXPECT_EQ(PulsesOf(plan, beams).size, 0u);
}

TEST(PointBeams, StoreOneNumberWhereAllPulsesHaveTheSame) {
  BeamPlan plan = AcrossTrack();
  plan.wind_speed = 6;
  const PulseBatch pulses = PulsesOf(plan, BeamsOf(plan, PointsOf({-1, -2, -3}, {-5, 0, 5})));
  EXPECT_EQ(pulses.size, 3u);
  EXPECT_EQ(pulses.axis[Index(AxisId::kWindSpeed)], std::vector<float>{6});
  EXPECT_EQ(pulses.axis[Index(AxisId::kFootprint)], std::vector<float>{0.5});
  EXPECT_TRUE(pulses.axis[Index(AxisId::kFetch)].empty());
  EXPECT_TRUE(pulses.axis[Index(AxisId::kAzimuth)].empty());
  EXPECT_EQ(pulses.axis[Index(AxisId::kIncidence)], (std::vector<float>{5, 0, 5}));
}

// The sensor stands 400 m above (100, 0), in feet or metres, until t = 1; after that its position is uncertain, and
// after t = 2 it is not known.
class StandingTrack final : public SensorTrack {
 public:
  void PositionsAt(std::span<const double> times, std::span<SensorPosition> positions,
                   std::span<TrackOutcome> outcomes) const override {
    for (std::size_t i = 0; i < times.size(); ++i) {
      positions[i] = {.x = 100, .z = 400, .metres_per_x = 2, .metres_per_y = 2, .convergence = 1 * kDegree};
      outcomes[i] = times[i] <= 1   ? TrackOutcome::kKnown
                    : times[i] <= 2 ? TrackOutcome::kUncertain
                                    : TrackOutcome::kOutside;
    }
  }
};

TEST(PointBeams, OfATrackFollowTheRefractedPath) {
  BeamPlan plan = AcrossTrack();
  plan.source = TrajectoryFromReturns();
  plan.footprint = DivergingBeam{.divergence = 2};
  plan.wind_from = 271;
  SurveyPoints points = PointsOf({0, -10, -10, -10}, {0, 0, 0, 0});
  points.times = {1, 1, 1.5, 3};
  const StandingTrack track;
  const PointBeams beams = BeamsOf(plan, points, &track);
  // At the surface, 200 m to the west of a sensor 400 m high: tan(incidence) = 1 / 2.
  EXPECT_NEAR(beams.incidence[0], std::atan(0.5) / kDegree, 1e-5);
  EXPECT_NEAR(beams.beam_azimuth[0], 271, 1e-4);                      // Grid west, by the convergence of 1 degree.
  EXPECT_NEAR(std::remainder(beams.azimuth[0] - 180, 360), 0, 1e-4);  // Against the wind.
  EXPECT_NEAR(beams.slant_range[0], std::hypot(200, 400), 1e-4);
  EXPECT_NEAR(beams.footprint[0], 2e-3 * std::hypot(200, 400), 1e-6);
  // A point 10 m under water is reached by Snell's law.
  const double incidence = beams.incidence[1] * kDegree;
  const double refracted = std::asin(std::sin(incidence) / plan.refractive_index);
  EXPECT_NEAR(400 * std::tan(incidence) + 10 * std::tan(refracted), 200, 1e-3);
  EXPECT_EQ(beams.depth[1], 10);
  EXPECT_EQ(beams.why_not[2], NoPulse::kUncertainTrajectory);
  EXPECT_EQ(beams.why_not[3], NoPulse::kNoTrajectory);
  EXPECT_TRUE(std::isnan(beams.incidence[3]));
  EXPECT_EQ(beams.depth[3], 10);
}

}  // namespace
}  // namespace albtpu::annotate
