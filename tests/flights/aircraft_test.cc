#include "tests/flights/aircraft.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/flights/survey_files.h"

namespace albtpu::testing {
namespace {

TEST(Ellipsoid, GeodeticCoordinatesReturn) {
  for (double latitude = -1.5; latitude < 1.5; latitude += 0.25) {
    for (const double height : {-50.0, 0.0, 600.0}) {
      const Geodetic there = GeodeticFrom(EarthCentred({latitude, 2, height}));
      EXPECT_NEAR(there.latitude, latitude, 1e-15);
      EXPECT_NEAR(there.longitude, 2, 1e-15);
      EXPECT_NEAR(there.height, height, 2e-9);
    }
  }
}

// In earth-centred coordinates, which the formula of the velocity does not use. Central differences over 1 ms: rounding
// 1e-9 m / 2 ms, and the third derivative of seconds-long motion, 1e-6 / 6.
TEST(Aircraft, VelocityIsTheDerivativeOfPosition) {
  RandomNumbers random(7);
  const AreaChart chart(0.47, -1.4);
  const Aircraft aircraft(chart, {.course = 2, .height = 380, .crab_angle = 0.1}, random);
  for (double time = -3; time < 40; time += 1.37) {
    const AircraftState here = aircraft.At(time);
    const Eigen::Vector3d change =
        EarthCentred(aircraft.At(time + 1e-3).position) - EarthCentred(aircraft.At(time - 1e-3).position);
    const Eigen::Matrix3d axes = EastNorthUp(here.position.latitude, here.position.longitude);
    EXPECT_NEAR(here.velocity.x(), axes.col(1).dot(change) / 2e-3, 2e-6);
    EXPECT_NEAR(here.velocity.y(), axes.col(0).dot(change) / 2e-3, 2e-6);
    EXPECT_NEAR(here.velocity.z(), axes.col(2).dot(change) / 2e-3, 2e-6);
  }
}

// Flying east: forward is east and right is south; the right wing goes down with roll, the nose up with pitch.
TEST(Aircraft, TurnsAsAttitudesAreDefined) {
  AircraftState state;
  state.position = {0.5, 1, 300};
  state.heading = 90 * kDegree;
  const Eigen::Matrix3d axes = EastNorthUp(0.5, 1);
  EXPECT_NEAR(axes.col(0).dot(state.BodyAxes().col(0)), 1, 1e-15);
  EXPECT_NEAR(axes.col(1).dot(state.BodyAxes().col(1)), -1, 1e-15);
  EXPECT_NEAR(axes.col(2).dot(state.BodyAxes().col(2)), -1, 1e-15);
  state.roll = 2 * kDegree;
  EXPECT_NEAR(axes.col(2).dot(state.BodyAxes().col(1)), -std::sin(2 * kDegree), 1e-15);
  state.roll = 0;
  state.pitch = 3 * kDegree;
  EXPECT_NEAR(axes.col(2).dot(state.BodyAxes().col(0)), std::sin(3 * kDegree), 1e-15);
}

// The formulas that readers of SBET use give the velocity and heading that went in. Times near 320000 s are rounded to
// 6e-11 s, in which velocities change by less than 1 m/s^2 times that.
TEST(SbetFile, TurnsVelocityAndHeadingIntoTheWanderFrame) {
  SurveyOptions options;
  options.seconds = 2;
  options.pulse_rate = 1;
  const SimulatedSurvey survey = Simulate(options);
  const TrajectoryOptions trajectory{.rate = 50, .margin = 1, .wander = 0.4};
  const std::string bytes = SbetFile(survey, trajectory);
  ASSERT_EQ(bytes.size(), (2 + 2 * 1) * 50 * 136 + 136);
  for (std::size_t record = 0; record * 136 < bytes.size(); ++record) {
    double field[17];
    std::memcpy(field, bytes.data() + record * 136, sizeof field);
    const AircraftState truth = survey.aircraft[0].At(field[0] - options.start);
    const double cosine = std::cos(field[10]), sine = std::sin(field[10]);
    EXPECT_NEAR(field[10], 0.4, 1e-3);
    EXPECT_NEAR(field[4] * cosine - field[5] * sine, truth.velocity.x(), 1e-10);
    EXPECT_NEAR(-(field[4] * sine + field[5] * cosine), truth.velocity.y(), 1e-10);
    EXPECT_NEAR(field[9] - field[10], truth.heading, 1e-10);
  }
}

TEST(SbetFile, HasNoRecordsInAGap) {
  SurveyOptions options;
  options.seconds = 10;
  options.pulse_rate = 1;
  const std::string bytes = SbetFile(Simulate(options), {.rate = 100, .gap_start = 4, .gap = 3});
  std::vector<double> times;
  for (std::size_t at = 0; at < bytes.size(); at += 136) {
    times.emplace_back();
    std::memcpy(&times.back(), bytes.data() + at, sizeof(double));
  }
  double longest = 0, before = 0;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i] - times[i - 1] > longest) longest = times[i] - times[i - 1], before = times[i - 1];
  EXPECT_EQ(longest, 3);
  EXPECT_EQ(before, options.start + 4);
}

}  // namespace
}  // namespace albtpu::testing
