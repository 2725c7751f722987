// Totals of dry points against draws of all errors through rotations and ranges, which use no formula of the budget.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "annotate/totals/pulse_totals.h"
#include "annotate/totals/total_summary.h"
#include "sea/angle.h"

namespace albtpu::annotate {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kAltitude = 400;  // m, of the sensor above the point.

struct Flight {
  double incidence, azimuth, roll, pitch, heading;  // degree
  Vector3d velocity, rates, lever;                  // m/s, degree/s, m
};

// From body axes (forward, right, down) to north, east, down; degree.
Matrix3d Turned(double roll, double pitch, double heading) {
  return (AngleAxisd(RadiansOfDegrees(heading), Vector3d::UnitZ()) *
          AngleAxisd(RadiansOfDegrees(pitch), Vector3d::UnitY()) *
          AngleAxisd(RadiansOfDegrees(roll), Vector3d::UnitX()))
      .toRotationMatrix();
}

Matrix3d SmallTurn(const Vector3d& degrees) {
  Matrix3d turn = Matrix3d::Identity();
  const Vector3d w = degrees * (std::numbers::pi / 180);
  turn << 1, -w.z(), w.y(), w.z(), 1, -w.x(), -w.y(), w.x(), 1;
  return turn;
}

TotalPlan PlanOnLand() {
  TotalPlan plan;
  plan.options.errors = {.position = {0.03, 0.02, 0.05},
                         .attitude = {0.004, 0.006, 0.012},
                         .boresight = {0.003, 0.002, 0.005},
                         .lever_arm = 0.02,
                         .scan = 0.005,
                         .time = 1e-4,
                         .range_offset = 0.01,
                         .bottom_range = 0.4,  // Has no effect on land.
                         .surface_range = 0.4,
                         .surface_height = 0.4,
                         .index = 0.1};
  plan.options.located = SurfaceLocation::kLevel;
  plan.options.datum = 0.03;
  plan.options.extra_horizontal = 0.06;
  plan.options.extra_vertical = 0.04;
  plan.hard_range = 0.025;
  return plan;
}

std::vector<Vector3d> DrawnErrors(const Flight& flight, const TotalPlan& plan, int draws) {
  const AirErrors& errors = plan.options.errors;
  std::mt19937_64 engine(17);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const auto three = [&](const std::array<double, 3>& sigma) {
    return Vector3d(sigma[0] * normal(engine), sigma[1] * normal(engine), sigma[2] * normal(engine));
  };
  const double incidence = RadiansOfDegrees(flight.incidence), azimuth = RadiansOfDegrees(flight.azimuth);
  const Vector3d u(std::sin(incidence) * std::cos(azimuth), std::sin(incidence) * std::sin(azimuth),
                   std::cos(incidence));
  const Vector3d outward(std::cos(incidence) * std::cos(azimuth), std::cos(incidence) * std::sin(azimuth),
                         -std::sin(incidence));
  const Vector3d sideways(-std::sin(azimuth), std::cos(azimuth), 0);
  const double range = kAltitude / std::cos(incidence), to_radians = std::numbers::pi / 180;
  const Matrix3d body = Turned(flight.roll, flight.pitch, flight.heading);
  const Vector3d truth = body * flight.lever + range * u;
  std::vector<Vector3d> drawn;
  for (int i = 0; i < draws; ++i) {
    const Vector3d position = three(errors.position), attitude = three(errors.attitude);
    const Vector3d boresight = three(errors.boresight);
    const Vector3d lever = three({errors.lever_arm, errors.lever_arm, errors.lever_arm});
    const Vector3d seen = u + errors.scan * to_radians * (normal(engine) * outward + normal(engine) * sideways);
    const double time = errors.time * normal(engine);
    const double ranged = range + plan.hard_range * normal(engine) + errors.range_offset * normal(engine);
    const Matrix3d turned =
        Turned(flight.roll + attitude.x(), flight.pitch + attitude.y(), flight.heading + attitude.z()) *
        SmallTurn(time * flight.rates);
    const Vector3d in_body = SmallTurn(boresight) * (body.transpose() * seen);
    Vector3d point = position + time * flight.velocity + turned * flight.lever + lever + ranged * (turned * in_body);
    point.z() += plan.options.datum * normal(engine) + plan.options.extra_vertical * normal(engine);
    // In any direction, by a distance whose mean square is the square of what was added.
    const double distance = plan.options.extra_horizontal * std::sqrt(-std::log1p(-uniform(engine)));
    const double direction = 2 * std::numbers::pi * uniform(engine);
    point += distance * Vector3d(std::cos(direction), std::sin(direction), 0);
    drawn.push_back(point - truth);
  }
  return drawn;
}

TotalBatch Computed(const Flight& flight, const TotalPlan& plan) {
  AircraftColumns aircraft;
  const auto put = [&](BudgetInput input, double value) { aircraft[input] = {static_cast<float>(value)}; };
  put(BudgetInput::kAltitude, kAltitude);
  put(BudgetInput::kBeamAzimuth, flight.azimuth);
  put(BudgetInput::kRoll, flight.roll);
  put(BudgetInput::kPitch, flight.pitch);
  put(BudgetInput::kHeading, flight.heading);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(BudgetInput::kVelocityNorth + axis, flight.velocity[static_cast<Eigen::Index>(axis)]);
    put(BudgetInput::kRollRate + axis, flight.rates[static_cast<Eigen::Index>(axis)]);
  }
  const std::vector<float> incidence = {static_cast<float>(flight.incidence)};
  TotalBatch totals;
  ComputeDryTotals(plan, incidence, aircraft, totals);
  return totals;
}

TEST(DryTotals, AreThoseOfDraws) {
  const Flight flights[] = {{20, 30, 2, -3, 75, {15, 55, 1}, {0, 0, 0}, {0, 0, 0}},
                            {0, 0, 0, 0, 0, {60, 0, 0}, {1, 2, -1}, {0.4, -0.1, 0.6}},
                            {35, 200, -8, 4, 310, {40, -40, 0}, {3, -2, 1}, {1.5, -0.3, 0.9}}};
  for (const Flight& flight : flights) {
    TotalPlan plan = PlanOnLand();
    for (std::size_t axis = 0; axis < 3; ++axis)
      plan.options.lever_arm[axis] = flight.lever[static_cast<Eigen::Index>(axis)];
    const std::vector<Vector3d> errors = DrawnErrors(flight, plan, 1000000);
    const auto draws = static_cast<double>(errors.size());
    Matrix3d drawn = Matrix3d::Zero();
    for (const Vector3d& error : errors) drawn += error * error.transpose() / draws;
    const TotalBatch totals = Computed(flight, plan);
    const double scale = drawn.trace();
    const double computed[6] = {totals.covariance[0][0], totals.covariance[1][0], totals.covariance[2][0],
                                totals.covariance[3][0], totals.covariance[4][0], totals.covariance[5][0]};
    const double expected[6] = {drawn(0, 0), drawn(1, 1), drawn(2, 2), drawn(0, 1), drawn(0, 2), drawn(1, 2)};
    // Of a million draws a variance is known to 0.14 %; four times that of the largest.
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(computed[i], expected[i], 0.006 * scale) << flight.incidence << " " << i;
    EXPECT_NEAR(totals.thu[0], 2 * std::sqrt(drawn(0, 0) + drawn(1, 1)), 0.005 * totals.thu[0]);
    EXPECT_NEAR(totals.tvu[0], 2 * std::sqrt(drawn(2, 2)), 0.005 * totals.tvu[0]);
    plan.options.coverage = Coverage::kP95;
    const TotalBatch at_95 = Computed(flight, plan);
    const auto share = [&](auto is_within) {
      return static_cast<double>(std::ranges::count_if(errors, is_within)) / draws;
    };
    EXPECT_NEAR(share([&](const Vector3d& e) { return e.head<2>().norm() <= at_95.thu[0]; }), 0.95, 0.0015);
    EXPECT_NEAR(share([&](const Vector3d& e) { return std::abs(e.z()) <= at_95.tvu[0]; }), 0.95, 0.0015);
  }
}

// A pulse without water, sea and errors of the surface is dry: the limit of no depth.
TEST(DryTotals, AreTheLimitOfNoDepth) {
  TotalPlan plan = PlanOnLand();
  AirErrors& errors = plan.options.errors;
  errors.surface_range = errors.surface_height = errors.index = 0;
  errors.bottom_range = plan.hard_range;
  errors.position[2] = errors.lever_arm = errors.time = errors.range_offset = plan.options.datum = 0;
  errors.attitude = errors.boresight = {};
  errors.scan = errors.bottom_range = plan.hard_range = 0;
  plan.options.located = SurfaceLocation::kPulse;
  errors.position = {0.03, 0.02, 0.05};
  errors.attitude = {0.004, 0.006, 0.012};
  const Flight flight = {20, 30, 2, -3, 75, {15, 55, 1}, {0, 0, 0}, {0, 0, 0}};
  const TotalBatch dry = Computed(flight, plan);
  BudgetInputs inputs{.size = 1};
  const std::array<float, 6> numbers = {20, 30, kAltitude, 0, 2, -3};
  const float heading = 75;
  for (std::size_t i = 0; i < numbers.size(); ++i) inputs[BudgetInput::kIncidence + i] = {&numbers[i], 1};
  inputs[BudgetInput::kHeading] = {&heading, 1};
  float thu = 0, tvu = 0;
  BudgetOutputs outputs;
  outputs.thu = {&thu, 1};
  outputs.tvu = {&tvu, 1};
  ComputeBudget(inputs, plan.options, outputs);
  EXPECT_NEAR(dry.thu[0], thu, 1e-5 * thu);
  EXPECT_NEAR(dry.tvu[0], tvu, 1e-5 * tvu);
}

TEST(DrySummary, CountsByRootMeanSquares) {
  const Flight flight = {20, 30, 0, 0, 0, {60, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  const TotalBatch totals = Computed(flight, PlanOnLand());
  DrySummary summary;
  summary.Add(totals, 0);
  summary.Add(totals, 0);
  EXPECT_EQ(summary.count(), 2u);
  EXPECT_NEAR(summary.Json()["rmse_vertical"].get<double>(), totals.tvu[0] / 2, 1e-6);
  EXPECT_NEAR(summary.Json()["rmse_horizontal"].get<double>(), totals.thu[0] / 2, 1e-6);
  double all = 0;
  for (std::size_t g = 0; g < kErrorGroups; ++g) {
    const double share = summary.Json()["groups_horizontal"][std::string(kErrorGroupNames[g])];
    const double variance = static_cast<double>(totals.groups[g][0][0]) + totals.groups[g][1][0];
    EXPECT_NEAR(share * std::pow(totals.thu[0] / 2, 2), variance, 1e-6 * variance);
    all += share;
  }
  EXPECT_NEAR(all, 1, 1e-9);
  EXPECT_EQ(DrySummary().Text(Coverage::kTwoSigma), "");
}

}  // namespace
}  // namespace albtpu::annotate
