// The columns of totals, held against the sources of one pulse in double precision.
#include "budget/total/budget_columns.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <random>

#include "budget/air/air_sources.h"
#include "budget/total/error_ellipse.h"
#include "sea/response/closed_form.h"
#include "tests/budget/total/total_memory.h"
#include "tests/degree.h"

namespace albtpu {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::TotalInputs;
using testing::TotalMemory;

using albtpu::testing::kDegree;

// Pulses of all kinds, over seas of all kinds.
TotalInputs RandomPulses(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  TotalInputs pulses;
  Draw(testing::kAircraftRanges, size, random, pulses);
  Draw(std::array<testing::InputRange, 10>{{{BudgetInput::kIncidence, 0, 30},
                                            {BudgetInput::kDepth, 0, 50},
                                            {BudgetInput::kSeaThu, 0.01f, 1},
                                            {BudgetInput::kSeaTvu, 0.01f, 0.3f},
                                            {BudgetInput::kRefractionAlong, 0.5f, 3},
                                            {BudgetInput::kRefractionCross, 0.5f, 3},
                                            {BudgetInput::kBiasAlongBeam, -0.1f, 0.1f},
                                            {BudgetInput::kBiasVertical, -0.1f, 0.1f},
                                            {BudgetInput::kSeaAxis, 0, 360},
                                            {BudgetInput::kWaveHeight, 0, 0.4f}}},
       size, random, pulses);
  return pulses;
}

const AirErrors kErrors = {.position = {0.02, 0.03, 0.06},
                           .attitude = {0.005, 0.004, 0.008},
                           .boresight = {0.001, 0.002, 0.004},
                           .lever_arm = 0.02,
                           .scan = 0.02,
                           .time = 1e-5,
                           .range_offset = 0.01,
                           .bottom_range = 0.025,
                           .surface_range = 0.02,
                           .surface_height = 0.03,
                           .index = 0.002};

AirPulse PulseAt(const TotalInputs& pulses, std::size_t i, const BudgetOptions& options) {
  const auto at = [&](BudgetInput input) { return pulses.at(input, i); };
  return {.incidence = at(BudgetInput::kIncidence),
          .beam_azimuth = at(BudgetInput::kBeamAzimuth),
          .altitude = at(BudgetInput::kAltitude),
          .depth = at(BudgetInput::kDepth),
          .roll = at(BudgetInput::kRoll),
          .pitch = at(BudgetInput::kPitch),
          .heading = at(BudgetInput::kHeading),
          .velocity = {at(BudgetInput::kVelocityNorth), at(BudgetInput::kVelocityEast), at(BudgetInput::kVelocityDown)},
          .rates = {at(BudgetInput::kRollRate), at(BudgetInput::kPitchRate), at(BudgetInput::kYawRate)},
          .lever_arm = Vector3d(options.lever_arm.data()),
          .index = options.index};
}

// The second derivatives of the refracted ray by the slope along and across the beam, on level water: of the tangent
// along and across it, and of the path times the cosine.
std::array<Eigen::Matrix2d, 3> CurvaturesOf(double incidence, double index) {
  constexpr double kStep = 2e-3;
  const Vector3d ray(std::sin(incidence), 0, -std::cos(incidence));
  const auto at = [&](double x, double y) {
    const RefractedRay refracted = RefractAtSlope(ray, Eigen::Vector2d(x * kStep, y * kStep), index);
    return Vector3d(refracted.tangent.x(), refracted.tangent.y(), refracted.secant);
  };
  const Vector3d xx = at(1, 0) + at(-1, 0) - 2 * at(0, 0), yy = at(0, 1) + at(0, -1) - 2 * at(0, 0);
  const Vector3d xy = (at(1, 1) + at(-1, -1) - at(1, -1) - at(-1, 1)) / 4;
  const double cosine = std::cos(StillWaterRefraction(incidence, index));
  std::array<Eigen::Matrix2d, 3> curvatures;
  for (int i = 0; i < 3; ++i) {
    curvatures[i] << xx[i], xy[i], xy[i], yy[i];
    curvatures[i] *= (i == 2 ? cosine : 1) / (kStep * kStep);
  }
  return curvatures;
}

// The covariance along, across and of the path times the cosine, of second order in slopes on the axes of the beam.
Matrix3d SecondOrderOf(const Eigen::Matrix2d& slopes, double incidence, double index) {
  const std::array<Eigen::Matrix2d, 3> curvatures = CurvaturesOf(incidence, index);
  Matrix3d second;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) second(i, j) = (curvatures[i] * slopes * curvatures[j] * slopes).trace() / 2;
  return second;
}

Matrix3d SeaContribution(const TotalInputs& pulses, std::size_t i, const BudgetOptions& options) {
  const auto at = [&](BudgetInput input) { return pulses.at(input, i); };
  const double turn = at(BudgetInput::kSeaAxis) * kDegree, azimuth = at(BudgetInput::kBeamAzimuth) * kDegree;
  const double incidence = at(BudgetInput::kIncidence) * kDegree, depth = at(BudgetInput::kDepth);
  Eigen::Matrix2d axes, of_beam;
  axes << std::cos(turn), -std::sin(turn), std::sin(turn), std::cos(turn);
  of_beam << std::cos(azimuth), -std::sin(azimuth), std::sin(azimuth), std::cos(azimuth);
  const double refracted = StillWaterRefraction(incidence, options.index);
  const Eigen::Matrix2d to_sea = axes.transpose() * of_beam;  // from the axes of the beam
  const SlopeGain gains = SmallSlopeGain(incidence, options.index);
  const Eigen::Matrix2d response =
      to_sea * Eigen::Vector2d(gains.in_plane, gains.out_of_plane).asDiagonal() * to_sea.transpose();
  // Slopes on the axes of the sea that, by Snell's law, have these variances; none below 0.
  const auto slopes_of = [&](const Eigen::Vector2d& variances) -> Eigen::Vector2d {
    return response.cwiseAbs2().partialPivLu().solve(variances).cwiseMax(Eigen::Vector2d::Zero());
  };
  const double along = at(BudgetInput::kRefractionAlong), cross = at(BudgetInput::kRefractionCross);
  const Eigen::Vector2d tangents = Eigen::Vector2d(along * along, cross * cross) * std::pow(kDegree / 2, 2);
  const Eigen::Vector2d variances = tangents * std::pow(at(BudgetInput::kSeaThu) / 2, 2) / tangents.sum();
  const double vertical = std::pow(at(BudgetInput::kSeaTvu) / 2, 2);
  const Eigen::Matrix2d on_beam = to_sea.transpose() * slopes_of(tangents).asDiagonal() * to_sea;
  Matrix3d second = depth * depth * SecondOrderOf(on_beam, incidence, options.index);
  const auto on_sea = [&]() -> Eigen::Matrix2d { return to_sea * second.topLeftCorner<2, 2>() * to_sea.transpose(); };
  // No part exceeds the whole.
  for (int axis = 0; axis < 2; ++axis)
    if (on_sea()(axis, axis) > variances[axis]) second *= variances[axis] / on_sea()(axis, axis);
  if (second(2, 2) > vertical) second *= vertical / second(2, 2);

  Eigen::Matrix2d on_axes = on_sea();
  on_axes += response * slopes_of(variances - on_axes.diagonal()).asDiagonal() * response.transpose();
  on_axes.diagonal() = variances;
  Matrix3d c = Matrix3d::Zero();
  c.topLeftCorner<2, 2>() = axes * on_axes * axes.transpose();
  c(2, 2) = vertical;
  const Eigen::Vector2d beam = of_beam.col(0);
  const Eigen::Vector2d first =
      (c.topLeftCorner<2, 2>() - of_beam * second.topLeftCorner<2, 2>() * of_beam.transpose()) * beam;
  const double left = std::max(0.0, vertical - second(2, 2)), by_snell = std::sin(refracted) * std::cos(refracted);
  const double lift = std::min(by_snell, std::sqrt(left / beam.dot(first)));
  c.topRightCorner<2, 1>() = -lift * first - of_beam * second.topRightCorner<2, 1>();
  c.bottomLeftCorner<1, 2>() = c.topRightCorner<2, 1>().transpose();
  // From the spot on a level bottom to the point at the measured range: farther out by tan r of what is too deep.
  Matrix3d to_point = Matrix3d::Identity();
  to_point.topRightCorner<2, 1>() = std::tan(refracted) * beam;
  c = to_point * c * to_point.transpose();
  const Vector3d wave = at(BudgetInput::kWaveHeight) * ErrorOfSurfaceHeight(PulseAt(pulses, i, options));
  return c + wave * wave.transpose();
}

// Relative to the standard deviations.
void ExpectSame(const Matrix3d& ours, const Matrix3d& twin, const char* what) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      ASSERT_NEAR(ours(row, column), twin(row, column), 1e-5 * std::sqrt(twin(row, row) * twin(column, column)) + 1e-12)
          << what << " " << row << column;
}

TEST(ComputeBudget, IsTheSumOfTheSourcesOfEachPulse) {
  const TotalInputs pulses = RandomPulses(1003, 1);
  for (const SurfaceLocation located : {SurfaceLocation::kPulse, SurfaceLocation::kLocal, SurfaceLocation::kLevel}) {
    const BudgetOptions options = {.errors = kErrors,
                                   .located = located,
                                   .lever_arm = {0.3, -0.2, 0.5},
                                   .datum = 0.08,
                                   .extra_horizontal = 0.05,
                                   .extra_vertical = 0.03};
    TotalMemory answers(1003);
    ComputeBudget(pulses.inputs(), options, answers.outputs());
    for (std::size_t i = 0; i < 1003; ++i) {
      std::array<Matrix3d, kErrorGroups> groups = {Matrix3d::Zero(), Matrix3d::Zero(), Matrix3d::Zero()};
      for (const AirSource& source : AirSources(PulseAt(pulses, i, options), located, kErrors))
        groups[static_cast<std::size_t>(source.group)] += source.Covariance();
      const Matrix3d air = groups[0] + groups[1] + groups[2], sea = SeaContribution(pulses, i, options);
      groups[0] += sea;
      groups[2] += Vector3d(0.05 * 0.05 / 2, 0.05 * 0.05 / 2, 0.08 * 0.08 + 0.03 * 0.03).asDiagonal();
      Matrix3d total = groups[0] + groups[1] + groups[2];
      ExpectSame(answers.Covariance(testing::kAirPart, i), air, "air");
      ExpectSame(answers.Covariance(testing::kSeaPart, i), sea, "sea");
      ExpectSame(answers.Covariance(testing::kTotalPart, i), total, "total");
      for (std::size_t g = 0; g < kErrorGroups; ++g)
        ExpectSame(answers.Covariance(static_cast<testing::TotalPart>(testing::kPulsePart + g), i), groups[g], "group");
      // The groups add up to the total.
      ExpectSame(answers.Covariance(testing::kPulsePart, i) + answers.Covariance(testing::kLinePart, i) +
                     answers.Covariance(testing::kSurveyPart, i),
                 total, "groups");
      ASSERT_NEAR(answers.numbers[0][i], 2 * std::sqrt(total(0, 0) + total(1, 1)), 1e-5 * answers.numbers[0][i]);
      ASSERT_NEAR(answers.numbers[1][i], 2 * std::sqrt(total(2, 2)), 1e-5 * answers.numbers[1][i]);
      const HorizontalEllipse ellipse = EllipseOf(total(0, 0), total(1, 1), total(0, 1));
      const double thu95 = RadiusFactor95(ellipse.semi_minor / ellipse.semi_major) * answers.numbers[0][i];
      ASSERT_EQ(answers.orders[i],
                BestOrderMet(thu95, kFactor95 * answers.numbers[1][i], pulses.at(BudgetInput::kBiasAlongBeam, i),
                             pulses.at(BudgetInput::kBiasVertical, i), pulses.at(BudgetInput::kDepth, i)));
    }
  }
}

// Errors that are drawn in any direction lie within what is stated of them as often as it says.
TEST(ExtraOf, HoldsDraws) {
  constexpr int kDraws = 200'000;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> normal;
  BudgetOptions options = {.extra_horizontal = 0.3, .extra_vertical = 0.2, .coverage = Coverage::kP95};
  const ExtraUncertainty p95 = ExtraOf(options);
  options.coverage = Coverage::kOneSigma;
  const ExtraUncertainty one = ExtraOf(options);
  int within_thu = 0, within_tvu = 0;
  double squares = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double distance = 0.3 * std::sqrt(-std::log1p(-uniform(random)));
    squares += distance * distance;
    within_thu += distance <= p95.thu;
    within_tvu += std::abs(0.2 * normal(random)) <= p95.tvu;
  }
  // Four standard errors: of a share of 0.95, and of the root of a mean square whose squares are exponential.
  const double share = 4 * std::sqrt(0.95 * 0.05 / kDraws);
  EXPECT_NEAR(within_thu, 0.95 * kDraws, share * kDraws);
  EXPECT_NEAR(within_tvu, 0.95 * kDraws, share * kDraws);
  EXPECT_NEAR(one.thu, std::sqrt(squares / kDraws), 4 * 0.3 / 2 / std::sqrt(kDraws));
  EXPECT_FLOAT_EQ(one.tvu, 0.2f);
  options.coverage = Coverage::kTwoSigma;
  EXPECT_FLOAT_EQ(ExtraOf(options).thu, 2 * one.thu);
}

TEST(ComputeBudget, StatesTheRadiusOf95PercentByTheTrueEllipse) {
  const TotalInputs pulses = RandomPulses(20, 2);
  const BudgetOptions options = {.errors = kErrors, .coverage = Coverage::kP95};
  TotalMemory answers(20);
  ComputeBudget(pulses.inputs(), options, answers.outputs());
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < 20; ++i) {
    const Eigen::LLT<Eigen::Matrix2d> root(answers.Covariance(testing::kTotalPart, i).topLeftCorner<2, 2>());
    int inside = 0;
    for (int draw = 0; draw < 200'000; ++draw) {
      const Eigen::Vector2d error = root.matrixL() * Eigen::Vector2d(normal(random), normal(random));
      inside += error.norm() <= answers.numbers[0][i];
    }
    EXPECT_NEAR(inside / 200'000.0, 0.95, 0.002) << i;  // 4 standard deviations
  }
}

TEST(ComputeBudget, HasNoBiasInAnyCovariance) {
  TotalInputs pulses = RandomPulses(100, 4);
  TotalMemory with(100), without(100);
  ComputeBudget(pulses.inputs(), {.errors = kErrors}, with.outputs());
  pulses[BudgetInput::kBiasAlongBeam] = {1000};
  pulses[BudgetInput::kBiasVertical] = {1000};
  ComputeBudget(pulses.inputs(), {.errors = kErrors}, without.outputs());
  EXPECT_EQ(with.numbers, without.numbers);
  EXPECT_NE(with.orders, without.orders);  // What is held against an order has them.
}

TEST(ComputeBudget, RepeatsConstantsAndTakesSigmasByPulse) {
  TotalInputs pulses = RandomPulses(130, 5), alike = pulses;
  for (const BudgetInput input : {BudgetInput::kDepth, BudgetInput::kSeaAxis, BudgetInput::kRoll}) {
    pulses[input] = {pulses[input][0]};
    alike[input].assign(130, pulses[input][0]);
  }
  alike[BudgetInput::kPositionSigmaNorth].assign(130, 0.02f);
  alike[BudgetInput::kHeadingSigma] = {0.008f};
  TotalMemory ours(130), others(130);
  ComputeBudget(pulses.inputs(), {.errors = kErrors}, ours.outputs());
  ComputeBudget(alike.inputs(), {.errors = kErrors}, others.outputs());
  EXPECT_EQ(ours.numbers, others.numbers);
}

TEST(ComputeBudget, AddsTheWaterColumnInThePlaneOfTheBeam) {
  TotalInputs pulses = RandomPulses(500, 5);
  const BudgetOptions options = {.errors = kErrors, .located = SurfaceLocation::kLocal, .datum = 0.08};
  TotalMemory without(500), with(500);
  ComputeBudget(pulses.inputs(), options, without.outputs());
  std::mt19937 random(9);
  Draw(std::array<testing::InputRange, 4>{{{BudgetInput::kWaterSigmaAlong, 0, 0.4f},
                                           {BudgetInput::kWaterSigmaVertical, 0, 0.3f},
                                           {BudgetInput::kWaterCorrelation, -1, 1},
                                           {BudgetInput::kWaterNoise, 0, 0.05f}}},
       500, random, pulses);
  ComputeBudget(pulses.inputs(), options, with.outputs());
  for (std::size_t i = 0; i < 500; ++i) {
    const auto at = [&](BudgetInput input) { return pulses.at(input, i); };
    const double azimuth = at(BudgetInput::kBeamAzimuth) * kDegree;
    const double refracted = std::asin(std::sin(at(BudgetInput::kIncidence) * kDegree) / options.index);
    const double along = at(BudgetInput::kWaterSigmaAlong), up = at(BudgetInput::kWaterSigmaVertical);
    // Along the beam and up, on the axes north, east, down.
    Eigen::Matrix<double, 3, 2> axes;
    axes << std::cos(azimuth), 0, std::sin(azimuth), 0, 0, -1;
    Eigen::Matrix2d shared;
    const double both = at(BudgetInput::kWaterCorrelation) * along * up;
    shared << along * along, both, both, up * up;
    const Matrix3d survey = axes * shared * axes.transpose();
    const Vector3d range = axes * Eigen::Vector2d(-std::tan(refracted), 1) * at(BudgetInput::kWaterNoise);
    const Matrix3d all = survey + range * range.transpose();
    ExpectSame(with.Covariance(testing::kWaterPart, i), all, "water");
    ExpectSame(with.Covariance(testing::kTotalPart, i), without.Covariance(testing::kTotalPart, i) + all, "total");
    ExpectSame(with.Covariance(testing::kPulsePart, i),
               without.Covariance(testing::kPulsePart, i) + range * range.transpose(), "pulse");
    ExpectSame(with.Covariance(testing::kLinePart, i), without.Covariance(testing::kLinePart, i), "line");
    ExpectSame(with.Covariance(testing::kSurveyPart, i), without.Covariance(testing::kSurveyPart, i) + survey,
               "survey");
    EXPECT_NEAR(with.numbers[6][i], 2 * std::sqrt(all(0, 0) + all(1, 1)), 1e-5 * with.numbers[6][i] + 1e-9);
    EXPECT_NEAR(with.numbers[7][i], 2 * std::sqrt(all(2, 2)), 1e-5 * with.numbers[7][i] + 1e-9);
  }
}

TEST(ComputeBudget, HasNoTotalWithoutTheSea) {
  TotalInputs pulses = RandomPulses(2, 6);
  pulses[BudgetInput::kSeaThu][1] = NAN;
  TotalMemory answers(2);
  ComputeBudget(pulses.inputs(), {.errors = kErrors}, answers.outputs());
  EXPECT_FALSE(std::isnan(answers.numbers[0][0]));
  EXPECT_TRUE(std::isnan(answers.numbers[0][1]));
  EXPECT_EQ(answers.orders[1], 0);
}

TEST(ComputeBudget, SpreadsASeaOfUnknownAxisAlike) {
  TotalInputs pulses = RandomPulses(1, 7);
  pulses[BudgetInput::kSeaAxis] = {};
  pulses[BudgetInput::kWaveHeight] = {};
  TotalMemory answers(1);
  ComputeBudget(pulses.inputs(), {.errors = kErrors}, answers.outputs());
  const Matrix3d sea = answers.Covariance(testing::kSeaPart, 0);
  // Of the spot on a level bottom; the reported point is restated along the beam alone.
  const double azimuth = pulses.at(BudgetInput::kBeamAzimuth, 0) * kDegree;
  const Eigen::Vector2d beam(std::cos(azimuth), std::sin(azimuth)), across(-beam.y(), beam.x());
  const Eigen::Matrix2d horizontal = sea.topLeftCorner<2, 2>();
  EXPECT_NEAR(std::sqrt(8 * across.dot(horizontal * across)), pulses[BudgetInput::kSeaThu][0], 1e-6);
  EXPECT_NEAR(beam.dot(horizontal * across), 0, 1e-6 * sea(0, 0));
}

TEST(ComputeBudget, StatesOneSigmaAsHalfOfTwo) {
  const TotalInputs pulses = RandomPulses(10, 8);
  TotalMemory one(10), two(10);
  ComputeBudget(pulses.inputs(), {.errors = kErrors, .coverage = Coverage::kOneSigma}, one.outputs());
  ComputeBudget(pulses.inputs(), {.errors = kErrors}, two.outputs());
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(2 * one.numbers[0][i], two.numbers[0][i]);
}

}  // namespace
}  // namespace albtpu
