#include "quality/surface/surface_tile.h"

#include <algorithm>
#include <cmath>

#include "quality/surface/cell_plane.h"

namespace albtpu::quality {
namespace {

constexpr int kSide = kTileCells + 2 * kTileBorder;  // With the border.

// The points of a tile by cell, each with its place in m from the middle of its cell.
class Cells {
 public:
  Cells(const TilePlace& tile, std::vector<SurfacePoint> points, double cell, double metres_per_unit)
      : points_(std::move(points)), side_(cell * metres_per_unit) {
    const std::int64_t west = tile.column * kTileCells - kTileBorder, south = tile.row * kTileCells - kTileBorder;
    std::vector<std::uint32_t> cells(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const std::int64_t column = static_cast<std::int64_t>(std::floor(points_[i].x / cell)) - west;
      const std::int64_t row = static_cast<std::int64_t>(std::floor(points_[i].y / cell)) - south;
      cells[i] = static_cast<std::uint32_t>(row * kSide + column);
      ++begin_[cells[i] + 1];
    }
    for (std::size_t c = 0; c < kCells; ++c) begin_[c + 1] += begin_[c];
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    std::vector<SurfacePoint> sorted(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) sorted[next[cells[i]]++] = points_[i];
    points_ = std::move(sorted);
    places_.resize(points_.size());
    kept_.assign(points_.size(), true);
    for (std::size_t c = 0; c < kCells; ++c)
      for (std::size_t i = begin_[c]; i < begin_[c + 1]; ++i) {
        const double x = (static_cast<double>(west + static_cast<std::int64_t>(c % kSide)) + 0.5) * cell;
        const double y = (static_cast<double>(south + static_cast<std::int64_t>(c / kSide)) + 0.5) * cell;
        places_[i] = {(points_[i].x - x) * metres_per_unit, (points_[i].y - y) * metres_per_unit};
      }
  }

  // Marks the points that take no part in the cells that have all neighbours.
  void LeaveOut() {
    std::vector<PlaneSums> medians(kCells);
    std::vector<double> heights;
    for (std::size_t c = 0; c < kCells; ++c) {
      if (begin_[c] == begin_[c + 1]) continue;
      heights.clear();
      Eigen::Vector2d middle = Eigen::Vector2d::Zero();
      for (std::size_t i = begin_[c]; i < begin_[c + 1]; ++i) {
        heights.push_back(points_[i].z);
        middle += places_[i];
      }
      const auto n = static_cast<double>(heights.size());
      middle /= n;
      medians[c].Add(middle.x(), middle.y(), MedianOf(heights), n);
    }
    ForInner([&](std::size_t c) {
      if (begin_[c + 1] - begin_[c] < 3) return;
      LeaveOutFar(Cell(c), PlaneOf(Around(medians, c, 1), side_), KeptOf(c));
    });
  }

  SurfaceNode Node(std::size_t c, const std::vector<PlaneSums>& kept, const NodeSources& sources) const {
    // Few points may tell no slope in 3 x 3 cells, but in 5 x 5.
    Plane plane;
    if (begin_[c] < begin_[c + 1]) plane = PlaneOf(Around(kept, c, 1), side_);
    if (begin_[c] < begin_[c + 1] && !plane.has_slope) plane = PlaneOf(Around(kept, c, kTileBorder), side_);
    return NodeOf(Cell(c), {kept_.data() + begin_[c], begin_[c + 1] - begin_[c]}, plane, sources);
  }

  std::vector<SurfaceNode> Nodes(const NodeSources& sources) const {
    std::vector<PlaneSums> kept(kCells);
    for (std::size_t c = 0; c < kCells; ++c)
      for (std::size_t i = begin_[c]; i < begin_[c + 1]; ++i)
        if (kept_[i]) kept[c].Add(places_[i].x(), places_[i].y(), points_[i].z);
    std::vector<SurfaceNode> nodes;
    nodes.reserve(std::size_t{kTileCells} * kTileCells);
    for (std::size_t row = 0; row < kTileCells; ++row)
      for (std::size_t column = 0; column < kTileCells; ++column)
        nodes.push_back(Node((row + kTileBorder) * kSide + column + kTileBorder, kept, sources));
    return nodes;
  }

 private:
  static constexpr std::size_t kCells = std::size_t{kSide} * kSide;

  CellPoints Cell(std::size_t c) const {
    const std::size_t count = begin_[c + 1] - begin_[c];
    return {{points_.data() + begin_[c], count}, {places_.data() + begin_[c], count}};
  }
  std::span<char> KeptOf(std::size_t c) { return {kept_.data() + begin_[c], begin_[c + 1] - begin_[c]}; }

  template <typename Do>
  void ForInner(Do&& visit) const {
    for (std::size_t row = 1; row + 1 < kSide; ++row)
      for (std::size_t column = 1; column + 1 < kSide; ++column) visit(row * kSide + column);
  }

  // Of the cells that are at most `reach` away in each direction, about the middle of the cell.
  PlaneSums Around(const std::vector<PlaneSums>& of_cells, std::size_t c, int reach) const {
    PlaneSums sum;
    for (int row = -reach; row <= reach; ++row)
      for (int column = -reach; column <= reach; ++column) {
        const auto other = static_cast<std::size_t>(static_cast<int>(c) + row * kSide + column);
        if (of_cells[other].n > 0) sum += of_cells[other].About(-column * side_, -row * side_);
      }
    return sum;
  }

  std::vector<SurfacePoint> points_;
  std::vector<Eigen::Vector2d> places_;  // m
  std::vector<char> kept_;
  std::vector<std::uint32_t> begin_ = std::vector<std::uint32_t>(kCells + 1);
  double side_;  // m
};

}  // namespace

std::vector<SurfaceNode> NodesOf(const TilePlace& tile, std::vector<SurfacePoint> points, double cell,
                                 double metres_per_unit, const NodeSources& sources) {
  Cells cells(tile, std::move(points), cell, metres_per_unit);
  cells.LeaveOut();
  return cells.Nodes(sources);
}

}  // namespace albtpu::quality
