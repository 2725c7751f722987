#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sea/quadrature/hankel_lattice.h"
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

// What the header says of the differences.
constexpr double kDifferences = 1e-6;

TEST(EffectiveGains, OfStillWaterAreThoseOfSmallSlopes) {
  const double incidence = 0.35, refracted = StillWaterRefraction(incidence, kN);
  const EffectiveGains gains = EffectiveGainsOf(incidence, kN, Eigen::Matrix2d::Zero());
  EXPECT_NEAR(gains.mean.x(), std::tan(refracted), 1e-14);
  EXPECT_NEAR(gains.mean.y(), 0, 1e-14);
  EXPECT_NEAR(gains.mean.z(), 1 / std::cos(refracted), 1e-14);
  const SlopeGain gain = SmallSlopeGain(incidence, kN);
  EXPECT_NEAR(gains.gain(0, 0), gain.in_plane, kDifferences);
  EXPECT_NEAR(gains.gain(1, 1), gain.out_of_plane, kDifferences);
  EXPECT_NEAR(gains.gain(2, 0), gain.in_plane * std::sin(refracted), kDifferences);
  EXPECT_LT((gains.curvature[2] - SecantCurvature(incidence, 0, kN)).norm(), 4 * kDifferences);
}

// The third order in slope (docs/physics.md): the gain by m_x falls by c (3 s_x^2 + s_y^2). The next order is smaller
// by some ten mean square slopes.
TEST(EffectiveGains, FallWithTheSlopesOfTheSea) {
  const double g = 1 - 1 / kN, c = 1.0 / 3 - 1 / (2 * kN) + 1 / (6 * kN * kN * kN) - g * g * g / 3;
  const double x = 7e-4, y = 5e-4;
  const EffectiveGains gains = EffectiveGainsOf(0, kN, Eigen::Vector2d(x, y).asDiagonal());
  EXPECT_NEAR((g - gains.gain(0, 0)) / (c * (3 * x + y)), 1, 10 * (x + y));
  EXPECT_NEAR((g - gains.gain(1, 1)) / (c * (x + 3 * y)), 1, 10 * (x + y));
}

// The slow twin: regression of the ray on the slope over a fine grid of slopes, each weighted by the area that it turns
// towards the beam: covariance under the weight times the inverse of the slopes' covariance.
TEST(EffectiveGains, AreTheRegressionOfTheRayOnTheSlope) {
  const double incidence = 0.4, tau = std::tan(incidence);
  const Eigen::Matrix2d slopes = (Eigen::Matrix2d() << 0.04, 0.01, 0.01, 0.025).finished();
  const Eigen::Matrix2d inverse = slopes.inverse(), root = slopes.llt().matrixL();
  const Eigen::Vector3d incident(std::sin(incidence), 0, -std::cos(incidence));
  double weights = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Vector2d mean_slope = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 3, 2> products = Eigen::Matrix<double, 3, 2>::Zero();
  constexpr double kStep = 0.05;
  for (double u = -7; u <= 7; u += kStep) {
    for (double v = -7; v <= 7; v += kStep) {
      const Eigen::Vector2d slope = root * Eigen::Vector2d(u, v);
      const RefractedRay ray = RefractAtSlope(incident, slope, kN);
      const Eigen::Vector3d value(ray.tangent.x(), ray.tangent.y(), ray.secant);
      const double weight = std::exp(-(u * u + v * v) / 2) * std::max(0.0, 1 + tau * slope.x());
      weights += weight;
      mean += weight * value;
      mean_slope += weight * slope;
      products += weight * value * slope.transpose();
    }
  }
  mean /= weights;
  mean_slope /= weights;
  const EffectiveGains gains = EffectiveGainsOf(incidence, kN, slopes);
  EXPECT_LT((gains.mean - mean).norm(), 1e-6);
  EXPECT_LT((mean_slope - tau * slopes.col(0)).norm(), 1e-6);
  const Eigen::Matrix<double, 3, 2> regression = (products / weights - mean * mean_slope.transpose()) * inverse;
  EXPECT_LT((gains.gain - regression).norm(), 2 * kDifferences);
}

const Eigen::Matrix2d kFlat = Eigen::Matrix2d::Zero();  // no resolved slopes

Eigen::Matrix2d Diagonal(double x, double y) { return Eigen::Vector2d(x, y).asDiagonal(); }

// Tangents and secant of a ray refracted by a facet of `slope`.
Eigen::Vector3d Refracted(const BeamOptions& beam, const Eigen::Vector2d& slope) {
  const Eigen::Vector3d incident(std::sin(beam.incidence) * std::cos(beam.azimuth),
                                 std::sin(beam.incidence) * std::sin(beam.azimuth), -std::cos(beam.incidence));
  const Eigen::Vector3d r = Refract(incident, NormalOfSlope(slope), kN);
  return Eigen::Vector3d(r.x(), r.y(), 1) / -r.z();
}

TEST(UnresolvedWaves, OfZeroSlopeChangeNothing) {
  const UnresolvedWaves none = EffectOfUnresolvedWaves({.incidence = 0.3, .azimuth = 0.5}, kN, Diagonal(0, 0), kFlat);
  EXPECT_LT(none.offset.norm(), 1e-15);
  EXPECT_LT(none.gain.norm(), 1e-12);  // rounding over the least deviation of slopes, 1e-3
}

// To first order the tangent is g times the slope, g = 1 - 1/n, so the secant is longer by half of g^2 mss.
// The next order is the square of mss: with a tenth of the mss the ratio departs a tenth as much.
TEST(UnresolvedWaves, LengthenThePathAtNadirByHalfOfGSquaredTimesTheirMeanSquareSlope) {
  const double g = 1 - 1 / kN;
  const auto departure = [&](double mss) {
    const double offset = EffectOfUnresolvedWaves({}, kN, Diagonal(0.6 * mss, 0.4 * mss), kFlat).offset.z();
    return offset / (0.5 * g * g * mss) - 1;
  };
  EXPECT_NEAR(departure(1e-4), 0, 1e-3);
  EXPECT_NEAR(departure(1e-2) / departure(1e-3), 10, 1.5);
}

TEST(UnresolvedWaves, AtNadirHaveNoPreferredDirection) {
  const UnresolvedWaves waves = EffectOfUnresolvedWaves({}, kN, Diagonal(0.02, 0.01), kFlat);
  EXPECT_LT(waves.offset.head<2>().norm(), 1e-15);
  EXPECT_LT(waves.gain.row(2).norm(), 1e-13);
}

// The tangent grows less than in proportion to the slope, so unresolved slopes make the mean response smaller.
TEST(UnresolvedWaves, ReduceTheResponseToTheResolvedWaves) {
  const UnresolvedWaves waves = EffectOfUnresolvedWaves({}, kN, Diagonal(0.02, 0.02), kFlat);
  EXPECT_LT(waves.gain(0, 0), 0);
  EXPECT_LT(waves.gain(1, 1), 0);
  EXPECT_GT(waves.gain(0, 0), -(1 - 1 / kN));
}

// The slow twin: random slopes, each weighted by the area that it turns towards the beam.
TEST(UnresolvedWaves, AreTheMeanOverRandomSlopesThatFaceTheBeam) {
  const BeamOptions beam{.incidence = 0.35, .azimuth = 0.6};
  const Eigen::Matrix2d covariance = Diagonal(0.012, 0.008);
  const UnresolvedWaves waves = EffectOfUnresolvedWaves(beam, kN, covariance, kFlat);
  constexpr int kDraws = 500000;
  const Eigen::Vector2d facing =
      std::tan(beam.incidence) * Eigen::Vector2d(std::cos(beam.azimuth), std::sin(beam.azimuth));
  // The weights average to 1 (+ facing . m), so the ratio estimator's error is that of weight (value - mean).
  const auto check = [&](const Eigen::Vector2d& m, double bias) {
    Eigen::Array3d sum = Eigen::Array3d::Zero(), squares = Eigen::Array3d::Zero();
    const Eigen::Array3d expected =
        (Refracted(beam, m) + waves.offset + waves.gain * m + waves.curvature * SlopeSquares(m)).array();
    double weights = 0;
    std::mt19937_64 bits(1);
    std::normal_distribution<double> normal;
    for (int i = 0; i < kDraws; ++i) {
      const double x = std::sqrt(covariance(0, 0)) * normal(bits), y = std::sqrt(covariance(1, 1)) * normal(bits);
      const Eigen::Vector2d slope = m + Eigen::Vector2d(x, y);
      const double weight = std::max(0.0, 1 + facing.dot(slope));
      const Eigen::Array3d departure = weight * (Refracted(beam, slope).array() - expected);
      weights += weight;
      sum += departure;
      squares += departure.square();
    }
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(sum[c] / weights, 0, 4 * std::sqrt(squares[c]) / weights + bias) << "component " << c;
  };
  check({0, 0}, 0);
  // The error of the expansion to second order in the resolved slope is of the order of mss m^3.
  check({0.05, -0.03}, 0.02 * 0.05 * 0.05 * 0.05);
}

// The slow twin: the change by unresolved waves, regressed on the resolved slopes of a fine quadrature and on their
// squares. Three nodes are exact to the next order in the resolved slopes, which the response at no slope leaves out;
// the order after that is smaller by their mean square.
TEST(UnresolvedWaves, AreTheMeanResponseToTheResolvedSlopes) {
  const BeamOptions beam{.incidence = 0.4, .azimuth = 0.5};
  const Eigen::Matrix2d unresolved = Diagonal(0.05, 0.04),
                        resolved = (Eigen::Matrix2d() << 0.05, 0.01, 0.01, 0.03).finished();
  const Eigen::Vector2d facing =
      std::tan(beam.incidence) * Eigen::Vector2d(std::cos(beam.azimuth), std::sin(beam.azimuth));
  const auto change = [&](const Eigen::Vector2d& m) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0;
    for (const QuadratureNode& x : GaussHermite(9)) {
      for (const QuadratureNode& y : GaussHermite(9)) {
        const Eigen::Vector2d slope =
            m + Eigen::Vector2d(std::sqrt(unresolved(0, 0)) * x.at, std::sqrt(unresolved(1, 1)) * y.at);
        const double weight = x.weight * y.weight * std::max(0.0, 1 + facing.dot(slope));
        sum += weight * Refracted(beam, slope);
        weights += weight;
      }
    }
    return Eigen::Vector3d(sum / weights - Refracted(beam, m));
  };
  const Eigen::Matrix2d root = resolved.llt().matrixL();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 2> products = Eigen::Matrix<double, 3, 2>::Zero();
  const UnresolvedWaves waves = EffectOfUnresolvedWaves(beam, kN, unresolved, resolved);
  Eigen::Vector3d expansion = Eigen::Vector3d::Zero();
  for (const QuadratureNode& x : GaussHermite(9)) {
    for (const QuadratureNode& y : GaussHermite(9)) {
      const Eigen::Vector2d m = root * Eigen::Vector2d(x.at, y.at);
      const Eigen::Vector3d here = x.weight * y.weight * change(m);
      mean += here;
      products += here * m.transpose();
      expansion += x.weight * y.weight * (waves.offset + waves.gain * m + waves.curvature * SlopeSquares(m));
    }
  }
  const Eigen::Matrix<double, 3, 2> regression = products * resolved.inverse();
  const double without = (EffectOfUnresolvedWaves(beam, kN, unresolved, kFlat).gain - regression).norm();
  EXPECT_LT((waves.gain - regression).norm(), resolved.trace() * without);
  EXPECT_LT((expansion - mean).norm(), std::pow(resolved.trace() + unresolved.trace(), 3));
}

}  // namespace
}  // namespace albtpu
