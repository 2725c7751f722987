#include <gtest/gtest.h>

#include <cmath>

#include "sea/response/closed_form.h"

namespace albtpu {
namespace {

constexpr double kN = kRefractiveIndex;

// A ray at `incidence` from the vertical, travelling towards +x.
Eigen::Vector3d Incident(double incidence) { return {std::sin(incidence), 0, -std::cos(incidence)}; }

TEST(Refraction, LeavesNormalIncidenceUnchanged) {
  const Eigen::Vector3d down(0, 0, -1);
  EXPECT_EQ(Refract(down, Eigen::Vector3d::UnitZ(), kN), down);
  const Eigen::Vector3d normal = NormalOfSlope({0.3, -0.2});
  EXPECT_LT((Refract(-normal, normal, kN) + normal).norm(), 1e-15);
}

TEST(Refraction, ObeysTheScalarLaw) {
  for (double incidence = 0; incidence < 1.55; incidence += 0.05) {
    const Eigen::Vector3d refracted = Refract(Incident(incidence), Eigen::Vector3d::UnitZ(), kN);
    EXPECT_NEAR(kN * refracted.x(), std::sin(incidence), 1e-15) << incidence;
    EXPECT_NEAR(std::atan2(refracted.x(), -refracted.z()), StillWaterRefraction(incidence, kN), 1e-15);
  }
}

TEST(Refraction, KeepsThePlaneOfIncidenceAndUnitLength) {
  for (const Eigen::Vector2d& slope : {Eigen::Vector2d(0.4, 0.1), {-0.2, 0.5}, {0, -1}}) {
    const Eigen::Vector3d incident = Incident(0.35);
    const Eigen::Vector3d normal = NormalOfSlope(slope);
    const Eigen::Vector3d refracted = Refract(incident, normal, kN);
    EXPECT_NEAR(refracted.norm(), 1, 1e-15);
    EXPECT_NEAR(incident.cross(normal).dot(refracted), 0, 1e-15);
    EXPECT_NEAR(kN * refracted.cross(normal).norm(), incident.cross(normal).norm(), 1e-15);
  }
}

TEST(Refraction, AtASlopeAgreesWithTheVectorForm) {
  for (const double incidence : {0.0, 0.2, 0.45}) {
    for (const Eigen::Vector2d& slope : {Eigen::Vector2d(0, 0), {0.4, 0.1}, {-0.2, 0.5}, {0, -1}}) {
      const Eigen::Vector3d direction = Refract(Incident(incidence), NormalOfSlope(slope), kN);
      const auto [tangent, secant] = RefractAtSlope(Incident(incidence), slope, kN);
      EXPECT_NEAR(secant, -1 / direction.z(), 1e-14);
      EXPECT_LT((tangent + direction.head<2>() / direction.z()).norm(), 1e-14);
    }
  }
}

TEST(Refraction, BendsTowardTheNormal) {
  const Eigen::Vector3d normal = NormalOfSlope({0.4, 0.1});
  const Eigen::Vector3d incident = Incident(0.35);
  EXPECT_GT(Refract(incident, normal, kN).dot(-normal), incident.dot(-normal));
}

TEST(Refraction, OnATiltedPlaneAgreesWithSnellsLawByHand) {
  // A vertical ray on a plane that rises to +x by 30 degrees meets it at 30 degrees and leaves it at
  // asin(0.5 / 1.33) = 22.082 degrees from its normal: 7.918 degrees from the vertical, towards +x.
  const double degree = std::acos(-1.0) / 180;
  const Eigen::Vector3d refracted = Refract({0, 0, -1}, NormalOfSlope({std::tan(30 * degree), 0}), kN);
  EXPECT_NEAR(std::atan2(refracted.x(), -refracted.z()) / degree, 30 - std::asin(0.5 / kN) / degree, 1e-12);
  EXPECT_NEAR(std::atan2(refracted.x(), -refracted.z()) / degree, 7.918, 5e-4);
  EXPECT_EQ(refracted.y(), 0);
}

TEST(Refraction, InStillWaterIsTheAngleOfThePaper) {
  const double degree = std::acos(-1.0) / 180;
  EXPECT_NEAR(StillWaterRefraction(20 * degree, kN) / degree, 14.90, 0.005);  // Birkebak et al. (2018), 4.3
}

TEST(SlopeGain, IsTheDerivativeOfTheRefractedTangent) {
  constexpr double kStep = 1e-5;  // central: error of the order of its square
  for (const double incidence : {0.0, 0.1, 0.35, 0.44, 0.9}) {
    const auto tangent = [&](double along, double across) {
      const Eigen::Vector3d refracted = Refract(Incident(incidence), NormalOfSlope({along, across}), kN);
      return Eigen::Vector2d(refracted.head<2>() / -refracted.z());
    };
    const SlopeGain gain = SmallSlopeGain(incidence, kN);
    const Eigen::Vector2d along = (tangent(kStep, 0) - tangent(-kStep, 0)) / (2 * kStep);
    const Eigen::Vector2d across = (tangent(0, kStep) - tangent(0, -kStep)) / (2 * kStep);
    EXPECT_NEAR(along.x(), gain.in_plane, 1e-8) << incidence;
    EXPECT_NEAR(across.y(), gain.out_of_plane, 1e-8) << incidence;
    EXPECT_NEAR(along.y(), 0, 1e-8);
    EXPECT_NEAR(across.x(), 0, 1e-8);
  }
}

TEST(SlopeGain, AtNadirIsOneMinusOneOverN) {
  const SlopeGain gain = SmallSlopeGain(0, kN);
  EXPECT_DOUBLE_EQ(gain.in_plane, 1 - 1 / kN);
  EXPECT_DOUBLE_EQ(gain.out_of_plane, 1 - 1 / kN);
}

// Slopes along and across the azimuth, turned into x and y.
TEST(TangentResponse, IsTheGainsInTheAxesOfTheBeam) {
  for (const double incidence : {0.0, 0.3}) {
    const SlopeGain gain = SmallSlopeGain(incidence, kN);
    for (const double azimuth : {0.0, 0.7, -2.0}) {
      const Eigen::Matrix2d response = TangentResponse(incidence, azimuth, kN);
      const Eigen::Vector2d along(std::cos(azimuth), std::sin(azimuth)), across(-along.y(), along.x());
      EXPECT_LT((response * along - gain.in_plane * along).norm(), 1e-15);
      EXPECT_LT((response * across - gain.out_of_plane * across).norm(), 1e-15);
    }
  }
}

TEST(TangentResponse, IsTheDerivativeOfTheRefractedTangentAtAnyAzimuth) {
  constexpr double kStep = 1e-5, kIncidence = 0.35, kAzimuth = 0.8;
  const Eigen::Vector3d incident(std::sin(kIncidence) * std::cos(kAzimuth), std::sin(kIncidence) * std::sin(kAzimuth),
                                 -std::cos(kIncidence));
  Eigen::Matrix2d derivative;
  for (const int axis : {0, 1}) {
    const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(axis);
    derivative.col(axis) =
        (RefractAtSlope(incident, step, kN).tangent - RefractAtSlope(incident, -step, kN).tangent) / (2 * kStep);
  }
  EXPECT_LT((derivative - TangentResponse(kIncidence, kAzimuth, kN)).norm(), 1e-8);
}

TEST(SecantCurvature, AtNadirIsTheSquareOfOneMinusOneOverN) {
  const double g = 1 - 1 / kN;
  EXPECT_LT((SecantCurvature(0, 0.4, kN) - g * g * Eigen::Matrix2d::Identity()).norm(), 1e-5);
}

}  // namespace
}  // namespace albtpu
