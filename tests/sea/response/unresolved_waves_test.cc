#include "sea/response/unresolved_waves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "generator/math/random_stream.h"
#include "sea/response/refraction.h"

namespace albtpu {
namespace {

constexpr double kN = kRefractiveIndex;

Eigen::Matrix2d Diagonal(double x, double y) { return Eigen::Vector2d(x, y).asDiagonal(); }

// Tangents and secant of the ray that a facet of `slope` refracts.
Eigen::Vector3d Refracted(const BeamOptions& beam, const Eigen::Vector2d& slope) {
  const Eigen::Vector3d incident(std::sin(beam.incidence) * std::cos(beam.azimuth),
                                 std::sin(beam.incidence) * std::sin(beam.azimuth),
                                 -std::cos(beam.incidence));
  const Eigen::Vector3d r = Refract(incident, NormalOfSlope(slope), kN);
  return Eigen::Vector3d(r.x(), r.y(), 1) / -r.z();
}

TEST(UnresolvedWaves, ThatAreNoneChangeNothing) {
  const UnresolvedWaves none =
      EffectOfUnresolvedWaves({.incidence = 0.3, .azimuth = 0.5}, kN, Diagonal(0, 0));
  EXPECT_LT(none.offset.norm(), 1e-15);
  EXPECT_LT(none.gain.norm(), 1e-13);
}

// The tangent is g times the slope to first order, g = 1 - 1/n, so the secant is longer by half of g^2 mss.
// The next order is the square of the mean square slope: a tenth of mss changes the ratio a tenth as much.
TEST(UnresolvedWaves, LengthenThePathAtNadirByHalfOfGSquaredTimesTheirMeanSquareSlope) {
  const double g = 1 - 1 / kN;
  const auto departure = [&](double mss) {
    const double offset = EffectOfUnresolvedWaves({}, kN, Diagonal(0.6 * mss, 0.4 * mss)).offset.z();
    return offset / (0.5 * g * g * mss) - 1;
  };
  EXPECT_NEAR(departure(1e-4), 0, 1e-3);
  EXPECT_NEAR(departure(1e-2) / departure(1e-3), 10, 1.5);
}

TEST(UnresolvedWaves, AtNadirFavourNoSide) {
  const UnresolvedWaves waves = EffectOfUnresolvedWaves({}, kN, Diagonal(0.02, 0.01));
  EXPECT_LT(waves.offset.head<2>().norm(), 1e-15);
  EXPECT_LT(waves.gain.row(2).norm(), 1e-13);
}

// The tangent rises less than in proportion to the slope, so a slope that is smeared out bends the beam less.
TEST(UnresolvedWaves, TakeFromTheAnswerToTheResolvedOnes) {
  const UnresolvedWaves waves = EffectOfUnresolvedWaves({}, kN, Diagonal(0.02, 0.02));
  EXPECT_LT(waves.gain(0, 0), 0);
  EXPECT_LT(waves.gain(1, 1), 0);
  EXPECT_GT(waves.gain(0, 0), -(1 - 1 / kN));
}

// The slow twin: slopes drawn one by one, each weighing as the area that it turns to the beam.
TEST(UnresolvedWaves, AreTheMeanOverRandomSlopesThatTheBeamSees) {
  const BeamOptions beam{.incidence = 0.35, .azimuth = 0.6};
  const Eigen::Matrix2d covariance = Diagonal(0.012, 0.008);
  const UnresolvedWaves waves = EffectOfUnresolvedWaves(beam, kN, covariance);
  constexpr int kDraws = 500000;
  std::vector<double> normals(2 * kDraws);
  NormalStream(1, 0, 0).Fill(normals);
  const Eigen::Vector2d facing =
      std::tan(beam.incidence) * Eigen::Vector2d(std::cos(beam.azimuth), std::sin(beam.azimuth));
  // The weights average to 1 (+ facing . m), so the ratio estimator's error is that of weight (value - mean).
  const auto check = [&](const Eigen::Vector2d& m, double bias) {
    Eigen::Array3d sum = Eigen::Array3d::Zero(), squares = Eigen::Array3d::Zero();
    const Eigen::Array3d expected =
        (Refracted(beam, m) + waves.offset + waves.gain * m + waves.curvature * SlopeSquares(m)).array();
    double weights = 0;
    for (int i = 0; i < kDraws; ++i) {
      const Eigen::Vector2d slope = m + Eigen::Vector2d(std::sqrt(covariance(0, 0)) * normals[2 * i],
                                                        std::sqrt(covariance(1, 1)) * normals[2 * i + 1]);
      const double weight = std::max(0.0, 1 + facing.dot(slope));
      const Eigen::Array3d departure = weight * (Refracted(beam, slope).array() - expected);
      weights += weight;
      sum += departure;
      squares += departure.square();
    }
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(sum[c] / weights, 0, 4 * std::sqrt(squares[c]) / weights + bias) << "component " << c;
    }
  };
  check({0, 0}, 0);
  // What the expansion to second order in the resolved slope leaves out, mss m^3.
  check({0.05, -0.03}, 0.02 * 0.05 * 0.05 * 0.05);
}

}  // namespace
}  // namespace albtpu
