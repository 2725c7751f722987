#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sea/quadrature/hankel_lattice.h"
#include "sea/response/closed_form.h"

namespace albtpu {
namespace {

constexpr double kN = kRefractiveIndex;
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
