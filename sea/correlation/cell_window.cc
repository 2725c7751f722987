#include "sea/correlation/cell_window.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "sea/quadrature/hankel_lattice.h"

namespace albtpu {
namespace {

double SquareOfSinc(double x) {
  if (x < 1e-3) return 1 - x * x / 3;
  const double sinc = std::sin(x) / x;
  return sinc * sinc;
}

// Of k a, in steps of the lattice: the same for cells of all sizes.
class WindowTable {
 public:
  static const WindowTable& Shared() {
    static const WindowTable table;
    return table;
  }

  // At ln(k a), by cubic interpolation. Beyond the last, all are below 1e-6.
  Eigen::Array<double, 1, kCellHarmonics + 1> At(double log_of_product) const {
    Eigen::Array<double, 1, kCellHarmonics + 1> values = Eigen::Array<double, 1, kCellHarmonics + 1>::Zero();
    const double position = (log_of_product - kFirst) / step_;
    if (position < 1) {
      values[0] = 1;
      return values;
    }
    const auto whole = static_cast<Eigen::Index>(position);
    if (whole + 2 >= means_.rows()) return values;
    const double t = position - static_cast<double>(whole);
    const double shares[] = {-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2, -(t + 1) * t * (t - 2) / 2,
                             (t + 1) * t * (t - 1) / 6};
    for (int n = 0; n < 4; ++n) values += shares[n] * means_.row(whole + n - 1);
    return values;
  }

 private:
  static constexpr double kFirst = -5.3, kLast = 6;  // ln of 0.005, where the window is 1 within 2e-6, and of 400
  static constexpr int kSamples = 8;                 // of a step

  WindowTable() : step_(HankelLattice::Shared().step()) {
    const int count = static_cast<int>((kLast - kFirst) / step_) + 1;
    Eigen::ArrayXXd fine((count + 2) * kSamples + 1, kCellHarmonics + 1);
    for (Eigen::Index i = 0; i < fine.rows(); ++i) {
      const double x = std::exp(kFirst + step_ * (static_cast<double>(i) / kSamples - 1)) / 2;
      const int directions = 16 + static_cast<int>(x);  // of an eighth of a turn
      fine.row(i).setZero();
      for (int d = 0; d < directions; ++d) {
        const double psi = std::numbers::pi / 4 * (d + 0.5) / directions;
        const double power = SquareOfSinc(x * std::cos(psi)) * SquareOfSinc(x * std::sin(psi)) / directions;
        for (int m = 0; m <= kCellHarmonics; ++m) fine(i, m) += power * std::cos(4 * m * psi);
      }
    }
    means_ = Eigen::ArrayXXd::Zero(count, kCellHarmonics + 1);
    for (int i = 0; i < count; ++i) {
      for (int j = -kSamples + 1; j < kSamples; ++j) {
        const double share = (1 - std::abs(j) / static_cast<double>(kSamples)) / kSamples;
        means_.row(i) += share * fine.row((i + 1) * kSamples + j);
      }
    }
  }

  double step_;
  Eigen::ArrayXXd means_;
};

}  // namespace

Eigen::ArrayXXd CellWindowOf(double side) {
  assert(side > 0);
  const Eigen::ArrayXd& k = HankelLattice::Shared().wavenumbers();
  Eigen::ArrayXXd window(k.size(), kCellHarmonics + 1);
  for (Eigen::Index i = 0; i < k.size(); ++i) window.row(i) = WindowTable::Shared().At(std::log(k[i] * side));
  return window;
}

namespace {

constexpr double kGaussianReach = 2;  // diameters: exp(-16) of the maximum

// Quadrature of the overlap of a footprint: circles of Gauss's radii, and of as many points each. The overlap of a
// uniform beam ends at x = 1 like a root: with x = sin t it is smooth in t.
std::vector<LagDensity::Node> OverlapNodes(const BeamOptions& beam, const Eigen::Vector2d& along) {
  constexpr int kRadii = 7, kTurns = 14;
  static const std::vector<QuadratureNode> uniform = GaussLegendre(kRadii, 0, std::numbers::pi / 2);
  static const std::vector<QuadratureNode> gaussian = GaussLegendre(kRadii, 0, kGaussianReach);
  const Eigen::Vector2d across(-along.y(), along.x());
  std::vector<LagDensity::Node> nodes;
  double sum = 0;
  for (int i = 0; i < kRadii; ++i) {
    const bool even = beam.profile == BeamProfile::kUniform;
    const double x = even ? std::sin(uniform[i].at) : gaussian[i].at;
    const double measure = even ? std::cos(uniform[i].at) * uniform[i].weight : gaussian[i].weight;
    const double weight = x * measure * FootprintOverlap(beam.profile, x);
    for (int j = 0; j < kTurns; ++j) {
      const double angle = 2 * std::numbers::pi * (j + (i % 2 == 0 ? 0.25 : 0.75)) / kTurns;
      const double r = x * beam.footprint;
      nodes.push_back({r * std::cos(angle) / std::cos(beam.incidence) * along + r * std::sin(angle) * across, weight});
      sum += weight;
    }
  }
  for (LagDensity::Node& node : nodes) node.weight /= sum;
  return nodes;
}

// Quadrature of the triangles of a square's density, on its axes.
std::vector<LagDensity::Node> SquareNodes(double side, const Eigen::Vector2d& axis) {
  static const std::vector<QuadratureNode> half = GaussLegendre(4, 0, 1);
  const Eigen::Vector2d other(-axis.y(), axis.x());
  std::vector<LagDensity::Node> nodes;
  for (const QuadratureNode& x : half) {
    for (const QuadratureNode& y : half) {
      const double weight = x.weight * (1 - x.at) * y.weight * (1 - y.at);
      for (const double sign_x : {-1, 1})
        for (const double sign_y : {-1, 1})
          nodes.push_back({side * (sign_x * x.at * axis + sign_y * y.at * other), weight});
    }
  }
  return nodes;
}

}  // namespace

LagDensity::LagDensity(const BeamOptions& beam) : LagDensity(beam, 0, 0) {}

LagDensity::LagDensity(const BeamOptions& beam, double side, double orientation)
    : beam_(beam),
      along_(std::cos(beam.azimuth), std::sin(beam.azimuth)),
      side_(side),
      axis_(std::cos(orientation), std::sin(orientation)) {
  width_ = beam.footprint * (beam.profile == BeamProfile::kGaussian ? kGaussianReach : 1) / std::cos(beam.incidence);
  reach_ = width_ + std::numbers::sqrt2 * side;
  over_cell_ = side < width_ / 2;
  nodes_ = over_cell_ && side > 0 ? SquareNodes(side, axis_) : OverlapNodes(beam, along_);
  if (side == 0 || over_cell_) return;
  const Eigen::Vector2d other(-axis_.y(), axis_.x());
  const auto count = static_cast<Eigen::Index>(nodes_.size());
  node_x_.resize(count), node_y_.resize(count), weights_.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Node& node = nodes_[static_cast<std::size_t>(i)];
    node_x_[i] = axis_.dot(node.at) / side, node_y_[i] = other.dot(node.at) / side, weights_[i] = node.weight;
  }
}

double LagDensity::OfFootprint(const Eigen::Vector2d& lag) const {
  const double cosine = std::cos(beam_.incidence);
  const double along = cosine * along_.dot(lag), across = along_.x() * lag.y() - along_.y() * lag.x();
  const double area = std::numbers::pi / 4 * beam_.footprint * beam_.footprint;
  return cosine / area * FootprintOverlap(beam_.profile, std::sqrt(along * along + across * across) / beam_.footprint);
}

double LagDensity::operator()(const Eigen::Vector2d& lag) const {
  if (side_ == 0) return OfFootprint(lag);
  double sum = 0;
  if (over_cell_) {
    for (const Node& node : nodes_) sum += node.weight * OfFootprint(lag - node.at);
    return sum;
  }
  const Eigen::Vector2d other(-axis_.y(), axis_.x());
  const double x = axis_.dot(lag) / side_, y = other.dot(lag) / side_;
  // Beyond the cell and a footprint there is nothing, and where no edge is within a footprint the mean is the value.
  const double far_x = std::abs(x), far_y = std::abs(y), margin = width_ / side_;
  if (std::max(far_x, far_y) >= 1 + margin) return 0;
  if (std::min(far_x, far_y) >= margin && std::max(far_x, far_y) <= 1 - margin)
    return (1 - far_x) * (1 - far_y) / (side_ * side_);
  const auto triangles = (1 - (x - node_x_).abs()).max(0) * (1 - (y - node_y_).abs()).max(0);
  return (weights_ * triangles).sum() / (side_ * side_);
}

}  // namespace albtpu
