#include "sea/correlation/cell_window.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sea/quadrature/hankel_lattice.h"

namespace albtpu {
namespace {

// By its definition, at many directions.
double WindowMean(double k, double side, int m) {
  constexpr int kDirections = 20000;
  double sum = 0;
  for (int d = 0; d < kDirections; ++d) {
    const double psi = 2 * std::numbers::pi * (d + 0.5) / kDirections;
    const double x = k * side / 2 * std::cos(psi), y = k * side / 2 * std::sin(psi);
    sum += std::pow(std::sin(x) / x * std::sin(y) / y, 2) * std::cos(4 * m * psi);
  }
  return sum / kDirections;
}

TEST(CellWindow, IsTheMeanOverDirectionsOfWhatASquareLeaves) {
  const Eigen::ArrayXd& k = HankelLattice::Shared().wavenumbers();
  for (const double side : {0.3, 2.0, 17.0}) {
    const Eigen::ArrayXXd window = CellWindowOf(side);
    for (const int i : {0, 60, 110, 130, 150, 160, 280}) {
      for (int m = 0; m <= kCellHarmonics; ++m) {
        // The means over a step alter a window of n lobes by (0.05 k a)^2 / 24 of a lobe.
        const double product = k[i] * side;
        const double allowed = 2e-5 + 0.002 * std::min(1.0, product * product) / std::max(1.0, product);
        EXPECT_NEAR(window(i, m), WindowMean(k[i], side, m), allowed) << k[i] << " 1/m, " << side << " m, " << m;
      }
    }
  }
}

// The integral over the plane, by a sum over squares.
double Integral(const LagDensity& density, double* second_moment = nullptr) {
  constexpr int kSteps = 120;
  const double step = 2 * density.reach() / kSteps;
  double sum = 0, moment = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const Eigen::Vector2d at(-density.reach() + (i + 0.5) * step, -density.reach() + (j + 0.5) * step);
      const double here = density(at) * step * step;
      sum += here;
      moment += here * at.x() * at.x();
    }
  }
  if (second_moment != nullptr) *second_moment = moment / sum;
  return sum;
}

TEST(LagDensity, HasTheMomentsOfTwoFootprintsAndTwoPointsOfTheCell) {
  for (const BeamProfile profile : {BeamProfile::kUniform, BeamProfile::kGaussian}) {
    const BeamOptions beam{.incidence = 0.5, .azimuth = 0, .footprint = 0.6, .profile = profile};
    for (const double side : {0.0, 0.1, 0.3, 0.7, 3.0}) {
      const LagDensity density(beam, side, 0.4);
      double moment = 0;
      EXPECT_NEAR(Integral(density, &moment), 1, 0.01) << side;
      // A point of either profile has the variance D^2 / 16 across the beam, a point of the square a^2 / 12.
      const double footprint = 2 * std::pow(0.6 / std::cos(0.5), 2) / 16, square = 2 * side * side / 12;
      EXPECT_NEAR(moment, footprint + square, 0.015 * (footprint + square)) << side << " m, " << Name(profile);
    }
  }
}

TEST(LagDensity, IsThatOfTheSquareWhereItIsEven) {
  const LagDensity density({.footprint = 0.2}, 4, 0.3);
  const Eigen::Vector2d x(std::cos(0.3), std::sin(0.3)), y(-x.y(), x.x());
  EXPECT_NEAR(density(1.5 * x - 2 * y), (1 - 1.5 / 4) * (1 - 2.0 / 4) / 16, 1e-12);
  EXPECT_NEAR(density(3 * x + 0.5 * y), (1 - 3.0 / 4) * (1 - 0.5 / 4) / 16, 1e-12);
  EXPECT_EQ(density(4.2 * x), 0);
}

// The sum over the footprint and that over the cell, on either side of the width at which one gives way to the other.
// The first has the errors of a sum over a hundred points across the edges of the square's density, which change from
// place to place.
TEST(LagDensity, IsTheSameByBothSums) {
  const BeamOptions beam{.footprint = 1, .profile = BeamProfile::kGaussian};
  const LagDensity narrower(beam, 1 - 1e-9, 0.2), wider(beam, 1 + 1e-9, 0.2);
  for (const Eigen::Vector2d& at :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(0.4, 0.1), Eigen::Vector2d(-0.5, 0.8), Eigen::Vector2d(1.2, 0.2)})
    EXPECT_NEAR(narrower(at), wider(at), 0.02 * wider({0, 0})) << at.transpose();
}

}  // namespace
}  // namespace albtpu
