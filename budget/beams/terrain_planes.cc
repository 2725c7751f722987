#include "budget/beams/terrain_planes.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "sea/samples.h"

namespace albtpu {
namespace {

constexpr double kFinestCell = 2;       // m
constexpr double kGreatestPlace = 1e7;  // m
constexpr std::size_t kReturnsOfPlane = 6;
// Of the standard deviation across the direction in which returns lie closest, in cells; 0.87 of an even window.
constexpr double kMinSpread = 0.3;
constexpr std::uint64_t kTriples = 50;  // Where a third of the returns is no ground, 15 of them are of ground alone.
constexpr double kAreaOfTriple = 0.25;  // Square cells.
constexpr int kRefinements = 2;
constexpr double kSmallest = 1e-3;    // m; smaller distances from the plane count as this.
constexpr double kOfMedian = 1.4826;  // The standard deviation of a normal distribution over its median deviation.
constexpr double kFarOut = 3;

std::int32_t CellOf(double number) { return static_cast<std::int32_t>(std::floor(number)); }

// Returns relative to the middle of a window.
struct Window {
  std::vector<double> x, y, z;
  std::vector<double> weights, distances, sorted;

  std::size_t size() const { return x.size(); }
  Eigen::Vector3d At(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

// z = a + b x + c y by weighted least squares; none where the points lie nearly on a line. `spread`: the least standard
// deviation of the horizontal places.
std::optional<Eigen::Vector3d> WeightedPlane(const Window& window, double spread) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < window.size(); ++i) {
    const Eigen::Vector3d row(1, window.x[i], window.y[i]);
    normal += window.weights[i] * row * row.transpose();
    right += window.weights[i] * window.z[i] * row;
  }
  const double sum = normal(0, 0);
  if (!(sum > 0)) return std::nullopt;
  const Eigen::Vector2d mean = normal.block<2, 1>(1, 0) / sum;
  const Eigen::Matrix2d scatter = normal.block<2, 2>(1, 1) / sum - mean * mean.transpose();
  const double half = scatter.trace() / 2;
  const double least = half - std::sqrt(std::max(half * half - scatter.determinant(), 0.0));
  if (least < spread * spread) return std::nullopt;
  return normal.ldlt().solve(right);
}

void FindDistances(const Eigen::Vector3d& plane, Window& window) {
  for (std::size_t i = 0; i < window.size(); ++i)
    window.distances[i] = std::abs(window.z[i] - plane[0] - plane[1] * window.x[i] - plane[2] * window.y[i]);
}

// Whether the median of the distances is less than `bound`, without sorting them.
bool MedianIsLess(const Window& window, double bound) {
  std::size_t less = 0;
  for (const double distance : window.distances) less += distance < bound ? 1 : 0;
  return less > window.size() / 2;
}

// Of the distances that were found.
double MedianDistance(Window& window) {
  window.sorted = window.distances;
  const auto middle = window.sorted.begin() + static_cast<std::ptrdiff_t>(window.sorted.size() / 2);
  std::nth_element(window.sorted.begin(), middle, window.sorted.end());
  return *middle;
}

// Of planes through three of the returns that span at least `area`, the one with the least median of distances
// (Rousseeuw 1984, doi:10.1080/01621459.1984.10477105); none if no three do.
std::optional<Eigen::Vector3d> LeastMedianPlane(double area, Window& window) {
  std::optional<Eigen::Vector3d> best;
  double least = std::numeric_limits<double>::infinity();
  const std::size_t count = window.size();
  for (std::uint64_t i = 0; i < kTriples; ++i) {
    const std::uint64_t draw = MixBits(i);
    const Eigen::Vector3d a = window.At(draw % count);
    const Eigen::Vector3d b = window.At((draw >> 20) % count) - a, c = window.At((draw >> 40) % count) - a;
    const Eigen::Vector3d normal = b.cross(c);
    if (!(std::abs(normal.z()) >= 2 * area)) continue;
    const double x = -normal.x() / normal.z(), y = -normal.y() / normal.z();
    const Eigen::Vector3d plane(a.z() - x * a.x() - y * a.y(), x, y);
    FindDistances(plane, window);
    if (!MedianIsLess(window, least)) continue;
    least = MedianDistance(window);
    best = plane;
  }
  return best;
}

std::optional<Eigen::Vector3d> RobustPlane(Window& window, double cell) {
  const std::size_t count = window.size();
  if (count < kReturnsOfPlane) return std::nullopt;
  window.weights.resize(count);
  window.distances.resize(count);
  std::optional<Eigen::Vector3d> plane = LeastMedianPlane(kAreaOfTriple * cell * cell, window);
  for (int i = 0; i < kRefinements && plane.has_value(); ++i) {
    FindDistances(*plane, window);
    const double farthest = kFarOut * std::max(kOfMedian * MedianDistance(window), kSmallest);
    std::size_t near = 0;
    for (std::size_t k = 0; k < count; ++k) {
      window.weights[k] = window.distances[k] <= farthest ? 1 : 0;
      near += window.distances[k] <= farthest;
    }
    if (near < kReturnsOfPlane) return std::nullopt;
    plane = WeightedPlane(window, kMinSpread * cell);
  }
  return plane;
}

}  // namespace

std::optional<TerrainPlanes::Gradient> TerrainPlanes::GradientAt(double x, double y) const {
  if (!(std::abs(x) < kGreatestPlace && std::abs(y) < kGreatestPlace)) return std::nullopt;
  const auto found = gradients_.find(Place(CellOf(x / cell_), CellOf(y / cell_)));
  return found == gradients_.end() ? std::nullopt : std::optional(found->second);
}

double TerrainReturns::cell() const { return std::ldexp(kFinestCell, level_); }

void TerrainReturns::Keep(const Sample& sample, Cell& cell) const {
  // Of equal hashes the place decides, so that the order of the returns does not.
  const auto key = [](const Sample& of) { return std::tuple(of.hash, of.x, of.y, of.z); };
  if (key(sample) >= key(cell.back())) return;
  std::size_t i = kKept - 1;
  for (; i > 0 && key(cell[i - 1]) > key(sample); --i) cell[i] = cell[i - 1];
  cell[i] = sample;
}

void TerrainReturns::Add(double x, double y, double z) {
  if (!(std::abs(x) < kGreatestPlace && std::abs(y) < kGreatestPlace && std::abs(z) < kGreatestPlace)) return;
  Sample sample{.x = static_cast<float>(x), .y = static_cast<float>(y), .z = static_cast<float>(z)};
  const auto bits = [](double number) { return std::bit_cast<std::uint64_t>(number); };
  const std::uint64_t place = MixBits(bits(x) + 0x9e3779b97f4a7c15 * bits(y));
  sample.hash = static_cast<std::uint32_t>(MixBits(place + bits(z)) >> 33);
  Keep(sample, cells_[Place(CellOf(x / cell()), CellOf(y / cell()))]);
  Bound();
}

void TerrainReturns::CoarsenTo(int level) {
  if (level <= level_) return;
  const int shift = level - level_;
  absl::flat_hash_map<Place, Cell> wider;
  for (const auto& [place, cell] : cells_) {
    Cell& to = wider[Place(place.first >> shift, place.second >> shift)];
    for (const Sample& sample : cell) Keep(sample, to);
  }
  cells_ = std::move(wider);
  level_ = level;
}

void TerrainReturns::Bound() {
  while (cells_.size() > kMostCells) CoarsenTo(level_ + 1);
}

void TerrainReturns::Merge(const TerrainReturns& other) {
  CoarsenTo(other.level_);
  for (const auto& [place, cell] : other.cells_) {
    const int shift = level_ - other.level_;  // Bound() widens cells.
    Cell& to = cells_[Place(place.first >> shift, place.second >> shift)];
    for (const Sample& sample : cell) Keep(sample, to);
    Bound();
  }
}

std::optional<TerrainPlanes::Gradient> TerrainReturns::PlaneAround(const Place& place) const {
  const double side = cell();
  const double x = (place.first + 0.5) * side, y = (place.second + 0.5) * side;
  Window window;
  for (std::vector<double>* axis : {&window.x, &window.y, &window.z}) axis->reserve(9 * kKept);
  std::optional<double> z;  // Of any return.
  for (int i = -1; i <= 1; ++i) {
    for (int k = -1; k <= 1; ++k) {
      const auto found = cells_.find(Place(place.first + i, place.second + k));
      if (found == cells_.end()) continue;
      for (const Sample& sample : found->second) {
        if (sample.hash == Sample().hash) continue;
        if (!z.has_value()) z = sample.z;
        window.x.push_back(sample.x - x);
        window.y.push_back(sample.y - y);
        window.z.push_back(sample.z - *z);
      }
    }
  }
  const std::optional<Eigen::Vector3d> plane = RobustPlane(window, side);
  if (!plane.has_value()) return std::nullopt;
  return TerrainPlanes::Gradient{static_cast<float>((*plane)[1]), static_cast<float>((*plane)[2])};
}

TerrainPlanes TerrainReturns::Finish() const {
  std::vector<Place> places;
  places.reserve(cells_.size());
  for (const auto& [place, cell] : cells_) places.push_back(place);
  std::vector<std::optional<TerrainPlanes::Gradient>> gradients(places.size());
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) { gradients[i] = PlaneAround(places[i]); });
  TerrainPlanes planes;
  planes.cell_ = cell();
  for (std::size_t i = 0; i < places.size(); ++i)
    if (gradients[i].has_value()) planes.gradients_.emplace(places[i], *gradients[i]);
  return planes;
}

}  // namespace albtpu
