#include "budget/total/terrain_error.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/degree.h"

namespace albtpu {
namespace {

constexpr int kDraws = 200'000;
using albtpu::testing::kDegree;
// 4 standard errors of a variance from normal draws, of itself.
const double kFourErrors = 4 * std::sqrt(2.0 / kDraws);

std::array<double, 6> Entries(const Eigen::Matrix3d& c) {
  return {c(0, 0), c(1, 1), c(2, 2), c(0, 1), c(0, 2), c(1, 2)};
}

TEST(TerrainError, IsThatOfTheHeightAtAFixedPlace) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int example = 0; example < 4; ++example) {
    Eigen::Matrix3d root;  // North, east, down.
    for (double& entry : root.reshaped()) entry = 0.1 * normal(random);
    const TerrainGradient g{0.5 * normal(random), 0.5 * normal(random)};
    double sum = 0;
    for (int i = 0; i < kDraws; ++i) {
      const Eigen::Vector3d error = root * Eigen::Vector3d(normal(random), normal(random), normal(random));
      // The reported point less the height of the terrain, z = g . h through the true point, at the reported place.
      sum += std::pow(-error.z() - (g.north * error.x() + g.east * error.y()), 2) / kDraws;
    }
    const std::array<double, 6> entries = Entries(root * root.transpose());
    EXPECT_NEAR(HeightVariance(entries, g) / sum, 1, kFourErrors);
    EXPECT_NEAR(HeightVariance(entries, {}), entries[2], 1e-15);
  }
}

// Horizontally and vertically it is in error, and yet no model of the terrain is.
TEST(TerrainError, IsNoneForAPointThatSlidesOnThePlane) {
  const TerrainGradient g{0.3, -0.2};
  const Eigen::Vector3d slide(0.7, 0.4, -(0.3 * 0.7 - 0.2 * 0.4));  // Down is minus the rise.
  EXPECT_NEAR(HeightVariance(Entries(slide * slide.transpose()), g), 0, 1e-15);
  EXPECT_GT(SlopeVariance(Entries(slide * slide.transpose()), g), 0.01);
}

TEST(TerrainError, TurnsGradientsFromTheGridToTrueNorth) {
  const double convergence = 0.03;
  const TerrainGradient g = OfGrid(0.3, -0.2, convergence);
  for (const double azimuth : {0.0, 1.0, 4.0}) {  // True; that of the grid is less by the convergence.
    const double of_grid = azimuth - convergence;
    EXPECT_NEAR(g.north * std::cos(azimuth) + g.east * std::sin(azimuth),
                0.3 * std::sin(of_grid) - 0.2 * std::cos(of_grid), 1e-15);
  }
}

// Rays of a diverging beam from the sensor meet the plane; each is reported on the axis, at its range.
struct Caster {
  double incidence, azimuth, range, footprint;
  TerrainGradient g;

  // The mean and the mean square of errors of height, m and m^2. `draw` gives a place in the footprint, in diameters.
  template <typename Draw>
  std::array<double, 2> Errors(const Draw& draw) const {
    const Eigen::Vector3d axis(std::sin(incidence * kDegree) * std::cos(azimuth * kDegree),
                               std::sin(incidence * kDegree) * std::sin(azimuth * kDegree),
                               std::cos(incidence * kDegree));
    const Eigen::Vector3d first = axis.unitOrthogonal(), second = axis.cross(first);
    const Eigen::Vector3d normal(g.north, g.east, 1);  // Of the plane through the end of the axis; down is positive.
    const double distance = normal.dot(range * axis);
    double sum = 0, squares = 0;
    for (int i = 0; i < kDraws; ++i) {
      const Eigen::Vector2d place = footprint * draw();
      const Eigen::Vector3d ray = (axis + (place.x() * first + place.y() * second) / range).normalized();
      const Eigen::Vector3d reported = distance / normal.dot(ray) * axis;
      const double error = -(normal.dot(reported) - distance);  // Vertically above the plane.
      sum += error / kDraws;
      squares += error * error / kDraws;
    }
    return {sum, squares};
  }
};

TEST(TerrainError, HasTheSpreadOfTheFootprintThatRaysFind) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto gaussian = [&] { return Eigen::Vector2d(normal(random) / 4, normal(random) / 4); };
  const auto disc = [&] {
    const double radius = std::sqrt(uniform(random)) / 2, angle = 2 * std::numbers::pi * uniform(random);
    return Eigen::Vector2d(radius * std::cos(angle), radius * std::sin(angle));
  };
  for (const Caster& caster :
       {Caster{0, 0, 400, 0.4, {0.4, 0}}, Caster{20, 0, 400, 0.4, {}}, Caster{20, 100, 400, 0.4, {-0.3, 0.5}},
        Caster{15, 250, 600, 4.2, {0.2, 0.2}}, Caster{20, 0, 400, 0.4, {0.3, 0}}}) {
    const double expected = FootprintVariance(caster.footprint, caster.incidence, caster.azimuth, caster.g);
    // To second order in the divergence, 1 % of the standard deviation for 7 mrad.
    const double second_order = caster.footprint / caster.range;
    const auto of_gaussian = caster.Errors(gaussian), of_disc = caster.Errors(disc);
    EXPECT_NEAR(of_gaussian[1] / expected, 1, kFourErrors + second_order);
    EXPECT_NEAR(of_disc[1] / expected, 1, kFourErrors + second_order);
    // Rays beside the axis are longer by d^2 / (2 range), in the mean by s^2 / range.
    const double longer = std::pow(caster.footprint / 4, 2) / caster.range;
    EXPECT_NEAR(of_gaussian[0], 0, 4 * std::sqrt(expected / kDraws) + second_order * std::sqrt(expected) + 2 * longer);
  }
}

TEST(TerrainError, OfAFootprintIsAQuarterOfItTimesTheSlopeBelowAVerticalBeam) {
  const double slope = 25 * kDegree;
  EXPECT_NEAR(std::sqrt(FootprintVariance(0.4, 0, 0, {0, std::tan(slope)})), 0.1 * std::tan(slope), 1e-15);
  EXPECT_NEAR(std::sqrt(FootprintVariance(0.4, 20, 70, {})), 0.1 * std::sin(20 * kDegree), 1e-15);
  // A plane across the beam, which rises where the beam travels to, has one range.
  EXPECT_NEAR(FootprintVariance(0.4, 20, 0, {std::tan(20 * kDegree), 0}), 0, 1e-15);
}

}  // namespace
}  // namespace albtpu
