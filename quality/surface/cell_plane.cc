#include "quality/surface/cell_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "budget/total/error_ellipse.h"
#include "sea/angle.h"
#include "tables/coverage.h"

namespace albtpu::quality {
namespace {

constexpr double kOfMedianDeviation = 1.4826;  // From a median deviation to a standard one, of normal errors.
constexpr int kPartsOfCircle = 3;              // Squares along its diameter, as the cells around a node.

// At a fixed place: a point that is moved to where the bottom is higher tells too small a height there.
double BiasOfHeight(const SurfacePoint& point, const Eigen::Vector2d& slope) {
  const double azimuth = RadiansOfDegrees(point.azimuth);
  return point.bias - point.bias_along_beam * slope.dot(Eigen::Vector2d(std::sin(azimuth), std::cos(azimuth)));
}

}  // namespace

double MedianOf(std::vector<double>& values) {
  const std::size_t middle = values.size() / 2;
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(middle));
  if (values.size() % 2 == 1) return values[middle];
  return (values[middle] + *std::max_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(middle))) / 2;
}

void LeaveOutFar(const CellPoints& cell, const Plane& plane, std::span<char> kept) {
  if (cell.points.size() < 3) return;
  std::vector<double> residuals;
  residuals.reserve(cell.points.size());
  for (std::size_t i = 0; i < cell.points.size(); ++i)
    residuals.push_back(cell.points[i].z - plane.slope.dot(cell.places[i]));
  std::vector<double> sorted = residuals;
  const double median = MedianOf(sorted);
  for (double& each : sorted) each = std::abs(each - median);
  const double rough = kOfMedianDeviation * MedianOf(sorted);
  for (std::size_t i = 0; i < cell.points.size(); ++i) {
    const SurfacePoint& p = cell.points[i];
    const double stated = std::sqrt(double{p.pulse} + p.sea + p.line);
    if (std::abs(residuals[i] - median) > kFarthest * std::max(stated, rough)) kept[i] = false;
  }
}

SurfaceNode NodeOf(const CellPoints& cell, std::span<const char> kept, const Plane& plane, const NodeSources& sources,
                   std::vector<LineOfNode>* lines) {
  SurfaceNode node;
  std::vector<SurfacePoint> others;  // Where some are left out.
  std::span<const SurfacePoint> points = cell.points;
  if (std::ranges::find(kept, false) != kept.end()) {
    for (std::size_t i = 0; i < kept.size(); ++i)
      if (kept[i]) others.push_back(cell.points[i]);
    points = others;
  }
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double mean = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i]) {
      ++node.left_out;
      continue;
    }
    const SurfacePoint& point = cell.points[i];
    middle += cell.places[i];
    mean += point.z;
    node.bias += BiasOfHeight(point, plane.slope);
    if (point.dry())
      ++node.dry;
    else
      node.depth += point.depth;
    node.thu += static_cast<float>(HorizontalRadius(point.xx, point.yy, point.xy).At(Coverage::kP95));
    if (!(point.z <= node.shoalest)) {
      node.shoalest = point.z;
      node.shoalest_sigma = std::sqrt(double{point.pulse} + point.sea + point.line + point.survey);
    }
  }
  if (points.empty()) return node;
  const auto n = static_cast<double>(points.size());
  node.points = static_cast<std::uint32_t>(points.size());
  middle /= n, mean /= n, node.bias /= n;
  node.depth /= static_cast<float>(node.points - node.dry), node.thu /= static_cast<float>(n);  // NaN over land.
  node.slope_x = static_cast<float>(plane.slope.x()), node.slope_y = static_cast<float>(plane.slope.y());
  node.elevation = mean - plane.slope.dot(middle);
  node.variance = VarianceOf(points, plane.slope, sources, lines);
  // The slope is no better known than the scatter of the points that it is made of.
  const double scatter = points.size() > 1 ? node.variance.within_cell(points.size()) : node.variance.pulse;
  // The mean of the cell is of points that the slope is made of, too: their covariance is U (middle - plane.middle).
  const Eigen::Vector2d lever = middle - 2 * (middle - plane.middle);
  node.variance.of_plane = std::max(-node.variance.pulse, scatter * middle.dot(plane.of_unit_noise * lever));
  node.variance.pulse += node.variance.of_plane;
  if (points.size() > 1) {
    double squares = 0;
    for (std::size_t i = 0; i < kept.size(); ++i)
      if (kept[i]) squares += std::pow(cell.points[i].z - mean - plane.slope.dot(cell.places[i] - middle), 2);
    node.deviation = std::sqrt(squares / (n - 1));
  }
  return node;
}

double SideOfCircle(double radius) { return radius * std::sqrt(std::numbers::pi); }

SurfaceNode NodeOfCircle(std::span<const SurfacePoint> points, double x, double y, double radius,
                         double metres_per_unit, const NodeSources& sources, std::vector<LineOfNode>& lines) {
  std::vector<Eigen::Vector2d> places;
  std::vector<char> kept(points.size(), true);
  const double side = 2 * radius / kPartsOfCircle;
  struct Part {
    PlaneSums sums;
    std::vector<double> heights;
  };
  std::array<Part, std::size_t{kPartsOfCircle} * kPartsOfCircle> parts;
  const auto step = [&](double at) {
    return std::clamp(static_cast<int>((at + radius) / side), 0, kPartsOfCircle - 1);
  };
  for (const SurfacePoint& point : points) {
    const Eigen::Vector2d& at = places.emplace_back((point.x - x) * metres_per_unit, (point.y - y) * metres_per_unit);
    Part& part = parts[static_cast<std::size_t>(step(at.y()) * kPartsOfCircle + step(at.x()))];
    part.sums.Add(at.x(), at.y(), 0);
    part.heights.push_back(point.z);
  }
  PlaneSums medians;
  for (Part& part : parts)
    if (part.sums.n > 0)
      medians.Add(part.sums.x / part.sums.n, part.sums.y / part.sums.n, MedianOf(part.heights), part.sums.n);
  const CellPoints cell = {points, places};
  LeaveOutFar(cell, PlaneOf(medians, side), kept);
  PlaneSums sums;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (kept[i]) sums.Add(places[i].x(), places[i].y(), points[i].z);
  const Plane plane = PlaneOf(sums, side);
  if (!plane.has_slope) return {};
  return NodeOf(cell, kept, plane, sources, &lines);
}

}  // namespace albtpu::quality
