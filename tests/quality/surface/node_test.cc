// Nodes in closed form: what averages out, and what does not.
#include "quality/surface/node.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "quality/surface/cell_plane.h"
#include "quality/surface/surface_tile.h"

namespace albtpu::quality {
namespace {

constexpr double kPulse = 0.0009, kSea = 0.0025, kLine = 0.0016, kSurvey = 0.0004;  // m^2

SurfacePoint PointAt(double time, std::uint16_t line = 1) {
  return {.x = 0.5,
          .y = 0.5,
          .z = -5,
          .time = time,
          .pulse = kPulse,
          .line = kLine,
          .survey = kSurvey,
          .sea = kSea,
          .incidence = 20,
          .footprint = 0.6F,
          .depth = 5,
          .flight_line = line};
}

// Pulses share `shared` of the sea's variance over a cell.
NodeSources Sharing(double shared, Eigen::Matrix3d errors = Eigen::Vector3d(0, 0, kSea / 25).asDiagonal()) {
  return {.sea =
              [=](auto, auto, auto, auto, std::span<const Eigen::Vector2d> places) {
                const auto n = static_cast<double>(places.size());
                return SeaOfPulses{.pulse = {.errors = errors}, .pairs = {.errors = n * (n - 1) * shared * errors}};
              },
          .groups = [](auto) { return HorizontalGroups{.pulse = 0.5, .line = 0.3, .survey = 0.2}; }};
}

NodeVariance LevelNode(const std::vector<SurfacePoint>& points, double shared) {
  return VarianceOf(points, Eigen::Vector2d::Zero(), Sharing(shared));
}

TEST(Node, AveragesThePulsesAndNotTheLineAndTheSurvey) {
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 10; ++i) points.push_back(PointAt(0.001 * i));
  const NodeVariance node = LevelNode(points, 0.7);
  EXPECT_NEAR(node.pulse, kPulse / 10, 1e-9);
  EXPECT_NEAR(node.sea, kSea * (0.7 + 0.3 / 10), 1e-9);
  EXPECT_NEAR(node.line, kLine, 1e-9);
  EXPECT_NEAR(node.survey, kSurvey, 1e-9);
  EXPECT_EQ(node.passes, 1);
}

TEST(Node, OfOnePointIsThatPoint) {
  EXPECT_NEAR(LevelNode({PointAt(0)}, 0.7).total(), kPulse + kSea + kLine + kSurvey, 1e-9);
}

TEST(Node, TakesPassesAsOtherWavesAndLinesAsOtherTrajectories) {
  // One line that looks ahead and back.
  std::vector<SurfacePoint> points = {PointAt(0), PointAt(0.01), PointAt(8), PointAt(8.01)};
  NodeVariance node = LevelNode(points, 1);
  EXPECT_EQ(node.passes, 2);
  EXPECT_NEAR(node.sea, kSea / 2, 1e-9);
  EXPECT_NEAR(node.line, kLine, 1e-9);
  // Another line, with three times as many points: (1/4)^2 + (3/4)^2.
  points = {PointAt(0), PointAt(500, 2), PointAt(500.01, 2), PointAt(500.02, 2)};
  node = LevelNode(points, 1);
  EXPECT_NEAR(node.sea, kSea * 10 / 16, 1e-9);
  EXPECT_NEAR(node.line, kLine * 10 / 16, 1e-9);
  // The same ID, used for another line.
  points = {PointAt(0), PointAt(60)};
  EXPECT_NEAR(LevelNode(points, 1).line, kLine / 2, 1e-9);
}

TEST(Node, OfASlopingBottomHasTheHorizontalErrorsToo) {
  SurfacePoint point = PointAt(0);
  Eigen::Matrix3d sea = Eigen::Matrix3d::Zero();  // Per depth^2.
  sea.diagonal() << 4e-4, 1e-4, kSea / 25;
  sea(0, 2) = sea(2, 0) = -1e-4;
  point.xx = 0.04F, point.yy = 0.02F, point.xy = 0.01F, point.xz = -0.003F, point.yz = 0.001F;
  const Eigen::Vector2d slope(0.3, -0.2);
  Eigen::Matrix3d all;
  all << point.xx, point.xy, point.xz, point.xy, point.yy, point.yz, point.xz, point.yz,
      kPulse + kSea + kLine + kSurvey;
  const Eigen::Vector3d g(-0.3, 0.2, 1);
  const std::vector<SurfacePoint> points = {point};
  const NodeVariance node = VarianceOf(points, slope, Sharing(0.5, sea));
  EXPECT_NEAR(node.total(), g.dot(all * g), 1e-8);
  EXPECT_NEAR(node.sea, 25 * g.dot(sea * g), 1e-8);
  const double by_slope = g.dot(all * g) - all(2, 2) - (25 * g.dot(sea * g) - kSea);
  EXPECT_NEAR(node.line, kLine + 0.3 * by_slope, 1e-8);
}

TEST(Node, TakesTheHeightOfUnseenWavesForWhatTheSlopesDoNotExplain) {
  // The stated variance is that of slopes and a height of 0.0010 m^2, of which the cell keeps 0.9.
  NodeSources sources = Sharing(0.2, Eigen::Vector3d(0, 0, (kSea - 0.001) / 25).asDiagonal());
  sources.sea = [of = sources.sea](auto source, auto incidence, auto azimuth, auto footprint, auto places) {
    SeaOfPulses sea = of(source, incidence, azimuth, footprint, places);
    const auto n = static_cast<double>(places.size());
    sea.pulse.height = 0.01, sea.pairs.height = n * (n - 1) * 0.009;
    return sea;
  };
  const std::vector<SurfacePoint> points(1000, PointAt(0));
  EXPECT_NEAR(VarianceOf(points, Eigen::Vector2d::Zero(), sources).sea, 0.2 * (kSea - 0.001) + 0.9 * 0.001, 2e-6);
}

TEST(Node, KeepsTheSeaOfBeamsThatAreNotKnown) {
  NodeSources sources = Sharing(0.2);
  sources.sea = [](auto, auto, auto, auto, auto) { return SeaOfPulses(); };
  EXPECT_NEAR(VarianceOf(std::vector{PointAt(0)}, Eigen::Vector2d::Zero(), sources).sea, kSea, 1e-9);
}

// Water that lies h too high makes a point too deep by b h, and too far along the beam by a h: at 20 degrees b = 0.232
// and a = 0.161. Up a slope of 0.3 the height at a fixed place errs by (b + 0.3 a) h, down it by (b - 0.3 a) h.
TEST(Node, OnASlopeHasWhatHeightsDoAlongTheBeam) {
  NodeSources sources = Sharing(0, Eigen::Matrix3d::Zero());
  sources.sea = [](auto, auto, auto, auto, std::span<const Eigen::Vector2d> places) {
    const auto n = static_cast<double>(places.size());
    return SeaOfPulses{
        .pulse = {.height = 0.01}, .pairs = {.height = n * (n - 1) * 0.009}, .by_height = {-0.161, 0, 0.232}};
  };
  SurfacePoint point = PointAt(0);
  point.xz = static_cast<float>(-0.161 / 0.232 * kSea), point.xx = point.xz * point.xz / static_cast<float>(kSea);
  for (const double slope : {0.3, -0.3}) {
    const double at_place = kSea * std::pow((0.232 + slope * 0.161) / 0.232, 2);
    const std::vector<SurfacePoint> points(1000, point);
    const NodeVariance node = VarianceOf(points, Eigen::Vector2d(slope, 0), sources);
    EXPECT_NEAR(node.sea, (0.9 + 0.1 / 1000) * at_place, 1e-7);
    EXPECT_NEAR(node.of_point, at_place + kPulse + kLine, 1e-7);
    // All of the horizontal error is the sea's.
    EXPECT_NEAR(node.line, kLine, 1e-7);
  }
}

// Six points under water and four beside it, of one pass.
TEST(Node, OfLandAndWaterHasTheWavesOfThePointsUnderWater) {
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 10; ++i) {
    points.push_back(PointAt(0.001 * i));
    if (i % 5 < 3) continue;
    points.back().sea = 0;
    points.back().depth = NAN;
  }
  const NodeVariance node = LevelNode(points, 0.7);
  EXPECT_NEAR(node.sea, 0.6 * 0.6 * kSea * (0.7 + 0.3 / 6), 1e-9);
  EXPECT_NEAR(node.pulse, kPulse / 10, 1e-9);
  EXPECT_NEAR(node.line, kLine, 1e-9);
  EXPECT_NEAR(node.of_point, 0.6 * kSea + kPulse + kLine, 1e-9);
  EXPECT_EQ(node.passes, 1);
}

TEST(Node, OfLandHasNoWavesAndNoDepth) {
  std::vector<SurfacePoint> points(4, PointAt(0));
  for (SurfacePoint& point : points) point.sea = 0, point.depth = NAN;
  const std::vector<Eigen::Vector2d> places(4, Eigen::Vector2d::Zero());
  std::vector<char> kept(4, true);
  SurfaceNode node = NodeOf({points, places}, kept, {}, Sharing(0.7));
  EXPECT_EQ(node.dry, 4U);
  EXPECT_EQ(node.variance.sea, 0);
  EXPECT_NEAR(node.variance.total(), kPulse / 4 + kLine + kSurvey, 1e-9);
  EXPECT_TRUE(std::isnan(node.depth));
  points[1].depth = 3;
  node = NodeOf({points, places}, kept, {}, Sharing(0.7));
  EXPECT_EQ(node.dry, 3U);
  EXPECT_EQ(node.depth, 3);
}

// Points that are reported 0.1 m too far to the east tell the height of what lies there; those whose beams went the
// other way are as much too far to the west.
TEST(Node, HasTheBiasOfItsPlaceOnASlope) {
  const std::vector<Eigen::Vector2d> places(2, Eigen::Vector2d::Zero());
  std::vector<char> kept(2, true);
  Plane plane;
  plane.slope = {0.3, 0.2};
  const auto bias = [&](std::array<float, 2> azimuths) {
    std::vector<SurfacePoint> points(2, PointAt(0));
    for (std::size_t i = 0; i < 2; ++i) points[i].azimuth = azimuths[i], points[i].bias = -0.02F;
    for (SurfacePoint& point : points) point.bias_along_beam = 0.1F;
    return NodeOf({points, places}, kept, plane, Sharing(0.7)).bias;
  };
  EXPECT_NEAR(bias({90, 90}), -0.02 - 0.3 * 0.1, 1e-8);
  EXPECT_NEAR(bias({180, 180}), -0.02 + 0.2 * 0.1, 1e-8);
  EXPECT_NEAR(bias({90, 270}), -0.02, 1e-8);
}

TEST(Node, PredictsTheScatterOfItsPoints) {
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 5; ++i) points.push_back(PointAt(0.001 * i));
  // All of the sea is common: only what is drawn anew for each pulse scatters.
  EXPECT_NEAR(LevelNode(points, 1).within_cell(5), kPulse, 1e-9);
  EXPECT_NEAR(LevelNode(points, 0).within_cell(5), kPulse + kSea, 1e-9);
}

// Tiles.

class Tile : public ::testing::Test {
 protected:
  // 9 points a cell on a plane, of all cells of a tile and its border.
  static std::vector<SurfacePoint> OnAPlane(double slope_x, double slope_y) {
    std::vector<SurfacePoint> points;
    for (int i = -3 * kTileBorder; i < 3 * (kTileCells + kTileBorder); ++i)
      for (int j = -3 * kTileBorder; j < 3 * (kTileCells + kTileBorder); ++j) {
        SurfacePoint point = PointAt(0.0001 * static_cast<double>(points.size()));
        point.x = (i + 0.3) / 3, point.y = (j + 0.6) / 3;
        point.z = -5 + slope_x * point.x + slope_y * point.y;
        points.push_back(point);
      }
    return points;
  }
};

TEST_F(Tile, OfAPlaneHasItsHeightsInTheMiddleOfCells) {
  const std::vector<SurfaceNode> nodes = NodesOf({}, OnAPlane(0.4, -0.1), 1, 1, Sharing(0.5));
  ASSERT_EQ(nodes.size(), kTileCells * kTileCells);
  for (int row = 0; row < kTileCells; ++row)
    for (int column = 0; column < kTileCells; ++column) {
      const SurfaceNode& node = nodes[static_cast<std::size_t>(row * kTileCells + column)];
      EXPECT_EQ(node.points, 9U);
      EXPECT_NEAR(node.elevation, -5 + 0.4 * (column + 0.5) - 0.1 * (row + 0.5), 1e-9);
      EXPECT_NEAR(node.slope_x, 0.4, 1e-6);
      EXPECT_NEAR(node.deviation, 0, 1e-7);
    }
}

// The plane is made of the cell's own points, too: with two points a cell this is 3 % of the variance.
TEST_F(Tile, OfFewIndependentPointsIsAsUncertainAsItSays) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> error(0, std::sqrt(kPulse + kSea));
  std::uniform_real_distribution<double> place(-kTileBorder, kTileCells + kTileBorder);
  constexpr int kSide = kTileCells + 2 * kTileBorder, kTiles = 60;
  double squares = 0, nodes = 0;
  for (int tile = 0; tile < kTiles; ++tile) {
    std::vector<SurfacePoint> points;
    for (int i = 0; i < 2 * kSide * kSide; ++i) {
      points.push_back(PointAt(1e-4 * i));
      points.back().x = place(random), points.back().y = place(random);
      points.back().z = -5 + error(random);
    }
    for (const SurfaceNode& node : NodesOf({}, points, 1, 1, Sharing(0))) {
      if (node.points == 0) continue;
      squares += std::pow(node.elevation + 5, 2) / (node.variance.pulse + node.variance.sea);
      ++nodes;
    }
  }
  EXPECT_NEAR(squares / nodes, 1, 3 * std::sqrt(2 / nodes));
}

TEST_F(Tile, LeavesOutPointsFarFromTheOthersAndCountsThem) {
  std::vector<SurfacePoint> points = OnAPlane(0.4, -0.1);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].x > 10 && points[i].x < 10.2 && points[i].y > 7 && points[i].y < 7.3) {
      points[i].z += 12;
      ++wrong;
    }
  ASSERT_EQ(wrong, 1U);
  const SurfaceNode node = NodesOf({}, points, 1, 1, Sharing(0.5))[7 * kTileCells + 10];
  EXPECT_EQ(node.left_out, 1U);
  EXPECT_EQ(node.points, 8U);
  EXPECT_NEAR(node.elevation, -5 + 0.4 * 10.5 - 0.1 * 7.5, 1e-9);
}

TEST_F(Tile, KeepsThePointsOfARoughBottom) {
  std::vector<SurfacePoint> points = OnAPlane(0, 0);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].z += 0.9 * static_cast<double>(i * 7919 % 101) / 101;
  std::uint32_t left_out = 0;
  for (const SurfaceNode& node : NodesOf({}, points, 1, 1, Sharing(0.5))) left_out += node.left_out;
  EXPECT_EQ(left_out, 0U);
}

// Circles, as check points have them.

TEST_F(Tile, HasTheHeightsOfAPlaneInCirclesToo) {
  std::vector<SurfacePoint> around;
  constexpr double kX = 12.34, kY = 20.1, kRadius = 2;
  for (const SurfacePoint& point : OnAPlane(0.4, -0.1))
    if (std::hypot(point.x - kX, point.y - kY) <= kRadius) around.push_back(point);
  around[20].z += 3;  // A fish.
  std::vector<LineOfNode> lines;
  const SurfaceNode node = NodeOfCircle(around, kX, kY, kRadius, 1, Sharing(0.5), lines);
  EXPECT_EQ(node.left_out, 1U);
  EXPECT_EQ(node.points, around.size() - 1);
  EXPECT_NEAR(node.elevation, -5 + 0.4 * kX - 0.1 * kY, 1e-9);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines[0].sigma * lines[0].sigma, node.variance.line, 1e-12);
  const auto n = static_cast<double>(node.points);
  // But for the plane, the mean is that of VarianceOf.
  EXPECT_NEAR(node.variance.pulse - node.variance.of_plane, kPulse / n, 1e-8);
  EXPECT_NEAR(node.variance.sea, kSea * (0.5 + 0.5 / n), 1e-8);
}

TEST_F(Tile, HasNoCircleWherePointsLieOnALine) {
  std::vector<SurfacePoint> around;
  for (int i = 0; i < 9; ++i) {
    around.push_back(PointAt(0.001 * i));
    around.back().x = 0.1 * i;
  }
  std::vector<LineOfNode> lines;
  EXPECT_EQ(NodeOfCircle(around, 0.4, 0.5, 1, 1, Sharing(0.5), lines).points, 0U);
}

}  // namespace
}  // namespace albtpu::quality
