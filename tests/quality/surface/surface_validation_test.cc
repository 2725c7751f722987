// Simulated surveys with truth: do the uncertainties of nodes hold?
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "quality/surface/surface_tile.h"
#include "tests/every_case.h"
#include "tests/quality/surface/simulated_place.h"

namespace albtpu::quality {
namespace {

using Eigen::Vector2d;

const std::vector<double> kCells = {0.5, 1, 2, 5};
using albtpu::testing::EveryCase;
// Places far from each other, with waves and errors of their own, by sets of seeds.
int Sets() { return EveryCase() ? 4 : 1; }
int PlacesOfSet() { return EveryCase() ? 1000 : 200; }

// Of the nodes of a place, or of many: over 1 and normalized variances, sums.
struct NodeSums {
  double nodes = 0, errors = 0;               // m, less the bias
  double ours = 0;                            // Squared errors over our variances.
  double held = 0;                            // Nodes within 1.96 of our standard deviations.
  double independent = 0, of_points = 0;      // As `ours`, by those of independent points and by the mean TVU.
  double within_cells = 0, with_several = 0;  // Scatter over the predicted one, of nodes of several points.
  double by_passes = 0, of_passes = 0;        // Of some nodes: what passes share, by theory, over our variances.

  void Add(const SurfaceNode& node, double truth) {
    const NodeVariance& v = node.variance;
    const double error = node.elevation - node.bias - truth, squared = error * error;
    ++nodes, errors += error, ours += squared / v.total();
    held += squared < std::pow(1.959964, 2) * v.total();
    independent += squared / (v.of_point + v.survey) * node.points, of_points += squared / (v.of_point + v.survey);
    if (v.within_cell(node.points) > 0)
      within_cells += std::pow(node.deviation, 2) / v.within_cell(node.points), ++with_several;
  }
};

// The nodes of one place share errors, those of two places do not.
class Places {
 public:
  explicit Places(std::span<const NodeSums> places) : places_(places) {}

  double Sum(double NodeSums::*of) const {
    double sum = 0;
    for (const NodeSums& place : places_) sum += place.*of;
    return sum;
  }
  // Per node, and its standard error.
  double Mean(double NodeSums::*of) const { return Sum(of) / Sum(&NodeSums::nodes); }
  double StandardError(double NodeSums::*of) const {
    const double mean = Mean(of);
    double squares = 0;
    for (const NodeSums& place : places_) squares += std::pow(place.*of - mean * place.nodes, 2);
    return std::sqrt(squares) / Sum(&NodeSums::nodes);
  }

 private:
  std::span<const NodeSums> places_;
};

constexpr double kMiddleOfPlace = SimulatedPlace::kWest + SimulatedPlace::kWidth / 2;
constexpr double kMostFromMiddle = 6;  // m, of nodes along both axes.

std::vector<SurfaceNode> NodesIn(const SimulatedPlace& place, const std::vector<SurfacePoint>& points, double cell) {
  std::vector<SurfacePoint> of_tile;
  const auto inside = [&](double at) {
    return std::abs(at - kMiddleOfPlace) < kMostFromMiddle + 2 * cell && at >= -cell && at < (kTileCells + 1) * cell;
  };
  for (const SurfacePoint& point : points)
    if (inside(point.x) && inside(point.y)) of_tile.push_back(point);
  return NodesOf({}, of_tile, cell, 1, place.SourcesFor(cell));
}

// Those of the nodes whose neighbours have all their points, too. Of small cells, those in the middle tell enough. Some
// tell what their passes share, where it is asked for.
void AddNodes(const std::vector<SurfaceNode>& nodes, double cell, const std::vector<SurfacePoint>& points,
              const WavesOfTwoPasses* of_passes, NodeSums& sums) {
  const double most = std::min(kMostFromMiddle, SimulatedPlace::kWidth / 2 - SimulatedPlace::kMargin - 1.5 * cell);
  const double apart = std::pow(2 * most / cell, 2) / 3;
  double next = apart / 2;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vector2d at(cell * (static_cast<double>(i % kTileCells) + 0.5),
                      cell * (static_cast<double>(i / kTileCells) + 0.5));
    if ((at - Vector2d::Constant(kMiddleOfPlace)).cwiseAbs().maxCoeff() > most || nodes[i].points == 0) continue;
    sums.Add(nodes[i], SimulatedPlace::HeightAt(at));
    if (of_passes == nullptr || sums.nodes < next) continue;
    next += apart;
    std::vector<SurfacePoint> of_node;
    for (const SurfacePoint& point : points)
      if ((Vector2d(point.x, point.y) - at).cwiseAbs().maxCoeff() < cell / 2) of_node.push_back(point);
    sums.by_passes += of_passes->VarianceOf(of_node) / nodes[i].variance.total(), ++sums.of_passes;
  }
}

struct NodeCase {
  std::string name;
  ScanPattern pattern;
  double spacing;  // m between the pulses of a pass
  bool always = false;
  // What all nodes of a place share hides what these share by waves: without it, a tenth as many places tell as much.
  double shared = 1;

  friend std::ostream& operator<<(std::ostream& out, const NodeCase& c) { return out << c.name; }
  // Two lines overlap, flown the opposite ways; of a raster, one has the place at nadir.
  std::vector<SimulatedLine> Lines() const {
    return {{.pattern = pattern, .number = 1, .heading = 30, .aside = 60, .start = 0},
            {.pattern = pattern,
             .number = 2,
             .heading = 210,
             .aside = pattern == ScanPattern::kRaster ? 3.0 : 90.0,
             .start = 600}};
  }
};

class NodesOfSurveys : public ::testing::TestWithParam<NodeCase> {};

TEST_P(NodesOfSurveys, LieWithinTheirUncertainty) {
  const NodeCase& c = GetParam();
  if (!c.always && !EveryCase()) GTEST_SKIP() << "ALBTPU_EVERY_CASE=1 runs it";
  const SimulatedPlace place(c.Lines(), c.spacing, kCells, c.shared);
  // What all nodes of a place share is most of the variance of large cells: it is drawn several times over its waves.
  const int draws = c.shared > 0 && EveryCase() ? 3 : 1;
  const auto places = static_cast<std::size_t>(Sets() * PlacesOfSet());
  std::vector<std::vector<NodeSums>> of_cells(kCells.size(), std::vector<NodeSums>(places));
  std::vector<DrawnSurvey> drawn(places);
  const WavesOfTwoPasses two_passes = place.OfTwoPasses();
  const std::size_t with_passes = c.shared > 0 ? 0 : EveryCase() ? 50 : 2;  // Places: theory takes long.
  tbb::parallel_for(std::size_t{0}, places, [&](std::size_t i) {
    drawn[i] = place.Survey(i + 1);
    for (int draw = 0; draw < draws; ++draw) {
      std::vector<SurfacePoint> points = drawn[i].points;
      place.DrawShared((i + 1) * 100 + static_cast<std::uint64_t>(draw)).AddTo(points);
      for (std::size_t cell = 0; cell < kCells.size(); ++cell)
        AddNodes(NodesIn(place, points, kCells[cell]), kCells[cell], points, i < with_passes ? &two_passes : nullptr,
                 of_cells[cell][i]);
    }
    drawn[i].points = {};
  });
  for (std::size_t cell = 0; cell < kCells.size(); ++cell) {
    const std::span<const NodeSums> all_places = of_cells[cell];
    const Places all(all_places);
    const double ours = all.Mean(&NodeSums::ours), standard_error = all.StandardError(&NodeSums::ours);
    std::printf(
        "%s, cells of %.1f m, %.0f nodes: normalized variance %.3f +- %.3f, %.1f +- %.1f %% within 95 %%; mean %+.1f "
        "+- %.1f mm; points as independent %.2f, mean TVU %.2f; scatter in cells %.3f; by sets",
        c.name.c_str(), kCells[cell], all.Sum(&NodeSums::nodes), ours, standard_error, 100 * all.Mean(&NodeSums::held),
        100 * all.StandardError(&NodeSums::held), 1000 * all.Mean(&NodeSums::errors),
        1000 * all.StandardError(&NodeSums::errors), all.Mean(&NodeSums::independent), all.Mean(&NodeSums::of_points),
        all.Sum(&NodeSums::within_cells) / all.Sum(&NodeSums::with_several));
    for (int set = 0; set < Sets(); ++set) {
      const Places one(all_places.subspan(static_cast<std::size_t>(set * PlacesOfSet()), PlacesOfSet()));
      std::printf(" %.3f +- %.3f", one.Mean(&NodeSums::ours), one.StandardError(&NodeSums::ours));
    }
    const double by_passes = c.shared > 0 ? 0 : all.Mean(&NodeSums::by_passes) / all.Mean(&NodeSums::of_passes);
    std::printf("; passes share %+.3f\n", by_passes);
    // A plane of four or five points: its slope, with its error, weighs what is horizontal, and shares waves with the
    // mean. By all pairs and the weights of the plane, variances should be 0.954 (raster) to 1.02 (ellipse) of ours.
    const bool few = c.shared == 0 && kCells[cell] < c.spacing;
    EXPECT_NEAR(ours, 1 + by_passes, (few ? 0.05 : 0.03) + 3 * standard_error) << kCells[cell];
    EXPECT_NEAR(all.Mean(&NodeSums::held), 0.95, 0.01 + 3 * all.StandardError(&NodeSums::held)) << kCells[cell];
  }
  double sum = 0, square = 0, stated = 0, n = 0;
  for (const DrawnSurvey& each : drawn) sum += each.sum, square += each.squares, stated += each.stated, n += each.n;
  std::printf("sea's share of single pulses, drawn over stated: %.3f\n", (square - sum * sum / n) / stated);
}

INSTANTIATE_TEST_SUITE_P(Cases, NodesOfSurveys,
                         ::testing::Values(NodeCase{"palmer_dense", ScanPattern::kPalmer, 0.45},
                                           NodeCase{"palmer_sparse", ScanPattern::kPalmer, 1},
                                           NodeCase{"raster_dense", ScanPattern::kRaster, 0.45},
                                           NodeCase{"raster_sparse", ScanPattern::kRaster, 1, true},
                                           NodeCase{"random_dense", ScanPattern::kRandom, 0.45},
                                           NodeCase{"random_sparse", ScanPattern::kRandom, 1},
                                           NodeCase{"waves_of_palmer_dense", ScanPattern::kPalmer, 0.45, false, 0},
                                           NodeCase{"waves_of_palmer_sparse", ScanPattern::kPalmer, 1, true, 0},
                                           NodeCase{"waves_of_raster_dense", ScanPattern::kRaster, 0.45, false, 0},
                                           NodeCase{"waves_of_raster_sparse", ScanPattern::kRaster, 1, false, 0},
                                           NodeCase{"waves_of_random_dense", ScanPattern::kRandom, 0.45, false, 0},
                                           NodeCase{"waves_of_random_sparse", ScanPattern::kRandom, 1, false, 0}),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace albtpu::quality
