#include "quality/surface/surface_tile.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace albtpu::quality {
namespace {

constexpr int kSide = kTileCells + 2 * kTileBorder;  // With the border.
constexpr double kOfMedianDeviation = 1.4826;        // From a median deviation to a standard one, of normal errors.

// Sums over points, from which the plane of least squares follows; x, y and z from the middle of a cell.
struct Moments {
  double n = 0, x = 0, y = 0, z = 0, xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;

  void Add(double dx, double dy, double dz, double weight = 1) {
    n += weight, x += weight * dx, y += weight * dy, z += weight * dz;
    xx += weight * dx * dx, xy += weight * dx * dy, yy += weight * dy * dy;
    xz += weight * dx * dz, yz += weight * dy * dz;
  }
  // The same about a point that lies (dx, dy) from the origin.
  Moments About(double dx, double dy) const {
    Moments m = *this;
    m.x = x - n * dx, m.y = y - n * dy;
    m.xx = xx - 2 * dx * x + n * dx * dx, m.yy = yy - 2 * dy * y + n * dy * dy;
    m.xy = xy - dx * y - dy * x + n * dx * dy;
    m.xz = xz - dx * z, m.yz = yz - dy * z;
    return m;
  }
  Moments& operator+=(const Moments& o) {
    n += o.n, x += o.x, y += o.y, z += o.z, xx += o.xx, xy += o.xy, yy += o.yy, xz += o.xz, yz += o.yz;
    return *this;
  }
};

struct Plane {
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  Eigen::Matrix2d of_unit_noise =
      Eigen::Matrix2d::Zero();                       // The covariance of the slope, if heights have the variance 1.
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  // The mean of its points, m from the middle of the cell.
  bool has_slope = false;
};

// Level where the points lie on a line or close together, so that they do not tell a slope. `side` of a cell, m.
Plane PlaneOf(const Moments& m, double side) {
  Plane plane;
  if (m.n < 4) return plane;
  Eigen::Matrix2d spread;
  spread << m.xx - m.x * m.x / m.n, m.xy - m.x * m.y / m.n, m.xy - m.x * m.y / m.n, m.yy - m.y * m.y / m.n;
  const double least_spread = spread.trace() / 2 - std::hypot((spread(0, 0) - spread(1, 1)) / 2, spread(0, 1));
  constexpr double kLeast = 0.3;  // Of a cell: evenly spread over 3 cells, points have 0.87.
  if (!(least_spread / m.n > kLeast * kLeast * side * side)) return plane;
  plane.of_unit_noise = spread.inverse();
  plane.middle = Eigen::Vector2d(m.x, m.y) / m.n;
  plane.slope = plane.of_unit_noise * Eigen::Vector2d(m.xz - m.x * m.z / m.n, m.yz - m.y * m.z / m.n);
  plane.has_slope = true;
  return plane;
}

double MedianOf(std::vector<double>& values) {
  const std::size_t middle = values.size() / 2;
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(middle));
  if (values.size() % 2 == 1) return values[middle];
  return (values[middle] + *std::max_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(middle))) / 2;
}

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
    std::vector<Moments> medians(kCells);
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
    std::vector<double> residuals, sorted;
    ForInner([&](std::size_t c) {
      if (begin_[c + 1] - begin_[c] < 3) return;  // Of two, who knows which is wrong.
      const Plane plane = PlaneOf(Around(medians, c, 1), side_);
      residuals.clear();
      for (std::size_t i = begin_[c]; i < begin_[c + 1]; ++i)
        residuals.push_back(points_[i].z - plane.slope.dot(places_[i]));
      sorted = residuals;
      const double median = MedianOf(sorted);
      for (double& each : sorted) each = std::abs(each - median);
      const double rough = kOfMedianDeviation * MedianOf(sorted);
      for (std::size_t i = begin_[c]; i < begin_[c + 1]; ++i) {
        const SurfacePoint& p = points_[i];
        const double stated = std::sqrt(double{p.pulse} + p.sea + p.line);
        if (std::abs(residuals[i - begin_[c]] - median) > kFarthest * std::max(stated, rough)) kept_[i] = false;
      }
    });
  }

  SurfaceNode Node(std::size_t c, const std::vector<Moments>& kept, const NodeSources& sources) const {
    SurfaceNode node;
    std::vector<SurfacePoint> others;  // Where some are left out.
    std::span<const SurfacePoint> points(points_.data() + begin_[c], begin_[c + 1] - begin_[c]);
    if (std::find(kept_.begin() + begin_[c], kept_.begin() + begin_[c + 1], false) != kept_.begin() + begin_[c + 1]) {
      for (std::size_t i = begin_[c]; i < begin_[c + 1]; ++i)
        if (kept_[i]) others.push_back(points_[i]);
      points = others;
    }
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    double mean = 0;
    for (std::size_t i = begin_[c]; i < begin_[c + 1]; ++i) {
      if (!kept_[i]) {
        ++node.left_out;
        continue;
      }
      middle += places_[i];
      mean += points_[i].z;
      node.bias += points_[i].bias;
      node.depth += points_[i].depth;
      node.thu += points_[i].thu;
      if (!(points_[i].z <= node.shoalest)) {
        node.shoalest = points_[i].z;
        node.shoalest_sigma =
            std::sqrt(double{points_[i].pulse} + points_[i].sea + points_[i].line + points_[i].survey);
      }
    }
    if (points.empty()) return node;
    const auto n = static_cast<double>(points.size());
    node.points = static_cast<std::uint32_t>(points.size());
    middle /= n, mean /= n, node.bias /= n;
    node.depth /= static_cast<float>(n), node.thu /= static_cast<float>(n);
    // Few points may tell no slope in 3 x 3 cells, but in 5 x 5.
    Plane plane = PlaneOf(Around(kept, c, 1), side_);
    if (!plane.has_slope) plane = PlaneOf(Around(kept, c, kTileBorder), side_);
    node.slope_x = static_cast<float>(plane.slope.x()), node.slope_y = static_cast<float>(plane.slope.y());
    node.elevation = mean - plane.slope.dot(middle);
    node.variance = VarianceOf(points, plane.slope, sources);
    // The slope is no better known than the scatter of the points that it is made of.
    const double scatter = points.size() > 1 ? node.variance.within_cell(points.size()) : node.variance.pulse;
    // The mean of the cell is of points that the slope is made of, too: their covariance is U (middle - plane.middle).
    const Eigen::Vector2d lever = middle - 2 * (middle - plane.middle);
    node.variance.of_plane = std::max(-node.variance.pulse, scatter * middle.dot(plane.of_unit_noise * lever));
    node.variance.pulse += node.variance.of_plane;
    if (points.size() > 1) {
      double squares = 0;
      for (std::size_t i = begin_[c]; i < begin_[c + 1]; ++i)
        if (kept_[i]) squares += std::pow(points_[i].z - mean - plane.slope.dot(places_[i] - middle), 2);
      node.deviation = std::sqrt(squares / (n - 1));
    }
    return node;
  }

  std::vector<SurfaceNode> Nodes(const NodeSources& sources) const {
    std::vector<Moments> kept(kCells);
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

  template <typename Do>
  void ForInner(Do&& visit) const {
    for (std::size_t row = 1; row + 1 < kSide; ++row)
      for (std::size_t column = 1; column + 1 < kSide; ++column) visit(row * kSide + column);
  }

  // Of the cells that are at most `reach` away in each direction, about the middle of the cell.
  Moments Around(const std::vector<Moments>& of_cells, std::size_t c, int reach) const {
    Moments sum;
    for (int row = -reach; row <= reach; ++row)
      for (int column = -reach; column <= reach; ++column) {
        const auto other = static_cast<std::size_t>(static_cast<int>(c) + row * kSide + column);
        if (of_cells[other].n > 0) sum += of_cells[other].About(-column * side_, -row * side_);
      }
    return sum;
  }

  std::vector<SurfacePoint> points_;
  std::vector<Eigen::Vector2d> places_;  // m
  std::vector<bool> kept_;
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
