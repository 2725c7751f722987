// The derivatives of the air side, held against an exact forward model.
#include "budget/air/air_sources.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <complex>
#include <random>

#include "tables/coverage.h"
#include "tests/budget/air/air_forward.h"
#include "tests/budget/query/budget_memory.h"
#include "tests/degree.h"

namespace albtpu {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::kAirUnknowns;
using testing::RandomPulse;
using testing::ReportedPoint;
using Jacobian = Eigen::Matrix<double, 3, kAirUnknowns>;
using Unknowns = Eigen::Matrix<double, kAirUnknowns, 1>;

using albtpu::testing::kDegree;

const AirErrors kOracle = testing::UsualOptions().errors;

// One standard deviation of each unknown of the forward model.
Unknowns Sigmas(const AirErrors& errors) {
  Unknowns sigma;
  sigma << errors.position[0], errors.position[1], errors.position[2], kDegree * errors.attitude[0],
      kDegree * errors.attitude[1], kDegree * errors.attitude[2], kDegree * errors.boresight[0],
      kDegree * errors.boresight[1], kDegree * errors.boresight[2], errors.lever_arm, errors.lever_arm,
      errors.lever_arm, kDegree * errors.scan, kDegree * errors.scan, errors.time, errors.range_offset,
      errors.bottom_range, errors.surface_height, errors.index;
  return sigma;
}

// Scaled by the standard deviations: the columns of all sources side by side.
Jacobian Ours(const AirPulse& pulse, SurfaceLocation located, const AirErrors& errors) {
  Jacobian columns;
  int next = 0;
  for (const AirSource& source : AirSources(pulse, located, errors)) {
    if (source.name == "surface_range") continue;  // An error of the height, seen along the beam.
    // Errors of the lever arm are alike on all axes, and those of the scan across the beam.
    columns.middleCols(next, source.columns.cols()) = source.columns;
    next += static_cast<int>(source.columns.cols());
  }
  EXPECT_EQ(next, kAirUnknowns);
  return columns;
}

Matrix3d Covariance(const AirPulse& pulse, SurfaceLocation located, const AirErrors& errors) {
  Matrix3d sum = Matrix3d::Zero();
  for (const AirSource& source : AirSources(pulse, located, errors)) sum += source.Covariance();
  return sum;
}

Jacobian ByDifferences(const AirPulse& pulse, bool given, const Unknowns& sigma) {
  Jacobian columns;
  for (int i = 0; i < kAirUnknowns; ++i) {
    // Far enough from rounding, near enough for third derivatives not to count.
    const bool is_angle = (i >= testing::kRoll && i <= testing::kBoresightZ) || i == testing::kScanA ||
                          i == testing::kScanB || i == testing::kIndex;
    const double step = is_angle ? 1e-5 : 1e-3;
    Unknowns there = Unknowns::Zero();
    there[i] = step;
    columns.col(i) = (ReportedPoint<double>(pulse, given, there) - ReportedPoint<double>(pulse, given, -there)) /
                     (2 * step) * sigma[i];
  }
  return columns;
}

// Exact to rounding: f(x + ih) = f(x) + ih f'(x) of an analytic function, up to h^2 (Squire and Trapp 1998,
// doi:10.1137/S003614459631241X).
Jacobian ByComplexSteps(const AirPulse& pulse, bool given, const Unknowns& sigma) {
  using Complex = std::complex<double>;
  constexpr double kStep = 1e-30;
  Jacobian columns;
  for (int i = 0; i < kAirUnknowns; ++i) {
    Eigen::Matrix<Complex, kAirUnknowns, 1> errors = Eigen::Matrix<Complex, kAirUnknowns, 1>::Zero();
    errors[i] = Complex(0, kStep);
    columns.col(i) = ReportedPoint<Complex>(pulse, given, errors).imag() / kStep * sigma[i];
  }
  return columns;
}

// Largest difference of any entry, relative to the largest entry of its column.
double Difference(const Jacobian& a, const Jacobian& b) {
  double worst = 0;
  for (int i = 0; i < kAirUnknowns; ++i)
    worst = std::max(worst, (a.col(i) - b.col(i)).norm() / std::max(a.col(i).norm(), 1e-9));
  return worst;
}

TEST(AirSources, AreTheDerivativesOfTheReportedPoint) {
  std::mt19937 random(1);
  const Unknowns sigma = Sigmas(kOracle);
  for (int i = 0; i < 2000; ++i) {
    const AirPulse pulse = RandomPulse(random);
    for (const bool given : {false, true}) {
      const Jacobian ours = Ours(pulse, given ? SurfaceLocation::kLevel : SurfaceLocation::kPulse, kOracle);
      Jacobian exact = ByComplexSteps(pulse, given, sigma), near = ByDifferences(pulse, given, sigma);
      // A lever arm errs alike on all axes of the aircraft: its three columns are those of the aircraft's axes.
      ASSERT_LT(Difference(ours, exact), 1e-9) << i << " " << given;
      ASSERT_LT(Difference(ours, near), 1e-6) << i << " " << given;
    }
  }
}

TEST(AirSources, AgreeWithDrawnErrors) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  const Unknowns sigma = Sigmas(kOracle);
  for (int i = 0; i < 6; ++i) {
    const AirPulse pulse = RandomPulse(random);
    const bool given = i % 2 == 1;
    const Matrix3d covariance = Covariance(pulse, given ? SurfaceLocation::kLevel : SurfaceLocation::kPulse, kOracle);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> ellipse(covariance.topLeftCorner<2, 2>());
    const double radius = RadiusFactor95(std::sqrt(ellipse.eigenvalues()[0] / ellipse.eigenvalues()[1])) * 2 *
                          std::sqrt(ellipse.eigenvalues().sum());
    const Vector3d truth = ReportedPoint<double>(pulse, given, Unknowns::Zero());
    constexpr int kDraws = 400'000;
    Matrix3d squares = Matrix3d::Zero();
    int inside = 0;
    for (int draw = 0; draw < kDraws; ++draw) {
      Unknowns errors;
      for (int j = 0; j < kAirUnknowns; ++j) errors[j] = sigma[j] * normal(random);
      const Vector3d error = ReportedPoint<double>(pulse, given, errors) - truth;
      squares += error * error.transpose();
      inside += error.head<2>().norm() <= radius;
    }
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(std::sqrt(squares(axis, axis) / kDraws / covariance(axis, axis)), 1, 0.005) << i;
    EXPECT_NEAR(static_cast<double>(inside) / kDraws, 0.95, 0.001) << i;
  }
}

TEST(AirSources, OfANadirBeamAreTheClosedForm) {
  const AirPulse pulse = {.altitude = 400, .depth = 10, .velocity = {70, 0, 0}};
  const Matrix3d c = Covariance(pulse, SurfaceLocation::kPulse, kOracle);
  const double lever = 400 + 10 / 1.34;
  EXPECT_NEAR(lever, 407.463, 5e-4);
  EXPECT_NEAR(std::sqrt(c(2, 2)), 0.0597052, 5e-8);
  EXPECT_NEAR(std::sqrt(c(1, 1)), 0.0414396, 5e-8);
  EXPECT_NEAR(c(0, 0), c(1, 1) + 0.0007 * 0.0007, 1e-12);
  const double angles = std::pow(kDegree * 0.0025, 2) + std::pow(kDegree * 0.001, 2) * 2;
  EXPECT_NEAR(c(1, 1), 0.03 * 0.03 + 0.02 * 0.02 + lever * lever * angles, 1e-12);
}

TEST(AirSources, OfAnObliqueBeamAreTheKnownNumbers) {
  const Vector3d velocity = Eigen::AngleAxisd(30 * kDegree, Vector3d::UnitZ()) * Vector3d(70, 2, 0);
  const AirPulse pulse = {.incidence = 20,
                          .beam_azimuth = 90,
                          .altitude = 400,
                          .depth = 10,
                          .roll = 3,
                          .pitch = 4,
                          .heading = 30,
                          .velocity = velocity,
                          .rates = Vector3d(0.01, 0.02, 0.03) / kDegree,
                          .lever_arm = {0.3, -0.2, 0.5}};
  // NN EE DD NE ND ED, 1e-6 m^2: computed apart from this code, by automatic differentiation.
  const auto is = [&](SurfaceLocation located, const std::array<double, 6>& known) {
    const Matrix3d c = Covariance(pulse, located, kOracle) * 1e6;
    const std::array<double, 6> ours = {c(0, 0), c(1, 1), c(2, 2), c(0, 1), c(0, 2), c(1, 2)};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(ours[i], known[i], 0.0051) << i;
  };
  is(SurfaceLocation::kPulse, {2011.89, 1837.13, 3551.88, 17.96, -6.91, 86.27});
  is(SurfaceLocation::kLevel, {2011.89, 1954.50, 2303.08, 19.06, -5.32, -263.03});
}

TEST(AirSources, WithoutLeverArmAndInStillAirDependOnTheBeamAlone) {
  AirPulse pulse = {.incidence = 20, .beam_azimuth = 40, .altitude = 400, .depth = 10};
  AirErrors errors = {.attitude = {0.004, 0.004, 0.004}};
  const Matrix3d level = Covariance(pulse, SurfaceLocation::kPulse, errors);
  pulse.heading = 123;
  EXPECT_TRUE(Covariance(pulse, SurfaceLocation::kPulse, errors).isApprox(level, 1e-12));
  errors = {.time = 1};
  EXPECT_EQ(Covariance(pulse, SurfaceLocation::kPulse, errors).norm(), 0);
}

TEST(AirSources, OfARangeToTheSurfaceAreThoseOfItsHeight) {
  const AirPulse pulse = {.incidence = 20, .altitude = 400, .depth = 10};
  const Matrix3d by_range = Covariance(pulse, SurfaceLocation::kPulse, {.surface_range = 0.02});
  const Matrix3d by_height =
      Covariance(pulse, SurfaceLocation::kPulse, {.surface_height = 0.02 * std::cos(20 * kDegree)});
  EXPECT_TRUE(by_range.isApprox(by_height, 1e-12));
  EXPECT_EQ(Covariance(pulse, SurfaceLocation::kLocal, {.surface_range = 0.02}).norm(), 0);
}

TEST(AirSources, InAirAllTheWayAreThoseOfTheWholeRange) {
  const AirPulse pulse = {.incidence = 20, .altitude = 400, .depth = 10, .index = 1};
  const AirErrors errors = {.scan = 0.01};
  const double range = 410 / std::cos(20 * kDegree);
  const Matrix3d c = Covariance(pulse, SurfaceLocation::kPulse, errors);
  EXPECT_NEAR(c.trace(), 2 * std::pow(range * 0.01 * kDegree, 2), 1e-12);
  // A given height of the surface says nothing where there is no water.
  EXPECT_TRUE(c.isApprox(Covariance(pulse, SurfaceLocation::kLevel, errors), 1e-9));
}

TEST(AirSources, PassHeightsOfTheTrajectoryInPartWhereALevelIsGiven) {
  AirPulse pulse = {.altitude = 400, .depth = 10};
  const auto passed = [&] {
    return std::sqrt(Covariance(pulse, SurfaceLocation::kLevel, {.position = {0, 0, 1}})(2, 2));
  };
  EXPECT_NEAR(passed(), 0.746, 5e-4);  // 1 / n
  pulse.incidence = 20;
  EXPECT_NEAR(passed(), 0.768, 1e-3);
  pulse.index = 1.33;
  EXPECT_NEAR(std::abs(ErrorOfSurfaceHeight(pulse).z()), 0.227, 1e-3);
  EXPECT_NEAR(ErrorOfSurfaceHeight(pulse).head<2>().norm(), 0.158, 1e-3);
}

}  // namespace
}  // namespace albtpu
