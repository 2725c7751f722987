#include "sea/correlation/slope_lags.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

#include "sea/quadrature/hankel_lattice.h"
#include "sea/spectra/spectrum_moments.h"

namespace albtpu {
namespace {

constexpr int kHarmonicOrders = WaveHarmonics::kLast + 1;
// Of half a turn: for the harmonics of products, and for the windows of cells.
constexpr int kHalfTurnDirections = 20;

// The means of cos(omega t) and sin(omega t) over the wavenumbers about each, with the weight of linear interpolation.
Eigen::ArrayXXd MeanTurns(const WaveMotion& motion, double time) {
  const HankelLattice& lattice = HankelLattice::Shared();
  Eigen::ArrayXXd turns(lattice.size(), 2);
  for (int i = 0; i < lattice.size(); ++i) {
    const double k = lattice.wavenumbers()[i], angle = AngularFrequency(k, motion.water_depth) * time;
    const double further = AngularFrequency(k * std::exp(lattice.step()), motion.water_depth) * time;
    const double half = (further - angle) / 2, sinc = half < 1e-4 ? 1 : std::sin(half) / half;
    turns.row(i) << sinc * sinc * std::cos(angle), sinc * sinc * std::sin(angle);
  }
  return turns;
}

// The product of the kernels of J_n, by lag and wavenumber, and `columns`, by wavenumber. An element depends on the sum
// of its indices, and those of few sums count: of these alone, for some lags at a time.
Eigen::MatrixXd ProductOfKernel(int n, int lags, const Eigen::MatrixXf& columns) {
  constexpr int kBlock = 16;
  const HankelLattice& lattice = HankelLattice::Shared();
  const HankelLattice::Kernel kernel = lattice.Bessel(n, 0, lags, 1);
  const auto [first, last] = lattice.Counting(n);
  Eigen::MatrixXf product = Eigen::MatrixXf::Zero(lags, columns.cols());
  for (int row = 0; row < lags; row += kBlock) {
    const int rows = std::min(kBlock, lags - row);
    const int begin = std::clamp(first - (row + rows - 1), 0, lattice.size());
    const int count = std::clamp(last - row, begin, lattice.size()) - begin;
    product.middleRows(row, rows).noalias() = kernel.block(row, begin, rows, count) * columns.middleRows(begin, count);
  }
  return product.cast<double>();
}

Eigen::Matrix3d Products(const Eigen::Array3d& r) { return r.matrix() * r.matrix().transpose(); }

}  // namespace

// As FootprintWaves::Between(), with the kernels of the lattice.
SlopeLags::SlopeLags(const FootprintWaves& points, const WaveMotion& motion, double later, double farthest)
    : symmetric_(later == 0 || motion.travel == WaveTravel::kBothWays) {
  const HankelLattice& lattice = HankelLattice::Shared();
  assert(farthest <= kFarthest);
  // Two more for interpolation.
  const int lags = std::max(4, static_cast<int>(lattice.IndexOfLag(farthest)) + 3);
  const Eigen::ArrayXXd turns = MeanTurns(motion, std::abs(later));
  const WaveHarmonics& waves = points.harmonics();
  for (Eigen::MatrixXd& sum : sum_) sum = Eigen::MatrixXd::Zero(lags, 2 * kHarmonicOrders);
  Eigen::MatrixXf columns(lattice.size(), 6);
  int used = 0;  // orders up to the last harmonic of the sea
  for (int n = 0; n < kHarmonicOrders; ++n) {
    if (symmetric_ && n % 2 == 1) continue;
    // Seas have few harmonics: beyond the last ones there is rounding alone.
    const double part = waves.sum(n).abs().sum() + waves.cosine(n).abs().sum();
    if (part < 1e-10 * waves.sum(0).abs().sum()) continue;
    used = n + 1;
    const double sign = (n % 4 < 2 ? 1 : -1) * (n % 2 == 1 && later < 0 ? -1 : 1);
    const Eigen::ArrayXd factor = 2 * std::numbers::pi * (n == 0 ? 1 : 2) * sign * turns.col(n % 2);
    const Eigen::ArrayXcd sum = waves.sum(n), cosine = waves.cosine(n);
    const Eigen::ArrayXcd functions[] = {0.5 * (sum + cosine), 0.5 * waves.sine(n), 0.5 * (sum - cosine)};
    for (int f = 0; f < 3; ++f) {
      columns.col(2 * f) = (factor * functions[f].real()).cast<float>();
      columns.col(2 * f + 1) = (factor * functions[f].imag()).cast<float>();
    }
    const Eigen::MatrixXd sums = ProductOfKernel(n, lags, columns);
    for (int f = 0; f < 3; ++f) sum_[f].middleCols(2 * n, 2) = sums.middleCols(2 * f, 2);
  }
  const int count = symmetric_ ? kHalfTurnDirections : 2 * kHalfTurnDirections;
  directions_.resize(2, count);
  Eigen::MatrixXd harmonics(2 * kHarmonicOrders, count);
  for (int d = 0; d < count; ++d) {
    const double beta = std::numbers::pi * (d + 0.5) / kHalfTurnDirections;
    directions_.col(d) << std::cos(beta), std::sin(beta);
    for (int n = 0; n < kHarmonicOrders; ++n) {
      harmonics(2 * n, d) = std::cos(n * beta);
      harmonics(2 * n + 1, d) = -std::sin(n * beta);
    }
  }
  for (int f = 0; f < 3; ++f) on_rings_[f] = sum_[f].leftCols(2 * used) * harmonics.topRows(2 * used);
}

Eigen::Array3d SlopeLags::At(const Eigen::Vector2d& lag) const {
  const HankelLattice& lattice = HankelLattice::Shared();
  const double position = std::max(0.0, lattice.IndexOfLag(std::max(lag.norm(), HankelLattice::kShortestLag)));
  const Eigen::Index last = sum_[0].rows() - 1;
  assert(position <= static_cast<double>(last));
  const Eigen::Index first = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(position) - 1, 0, last - 3);
  const double t = position - static_cast<double>(first + 1);
  const Eigen::RowVector4d shares(-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2,
                                  -(t + 1) * t * (t - 2) / 2, (t + 1) * t * (t - 1) / 6);
  const double beta = lag.isZero() ? 0 : std::atan2(lag.y(), lag.x());
  Eigen::VectorXd harmonics(2 * kHarmonicOrders);
  for (int n = 0; n < kHarmonicOrders; ++n) {
    harmonics[2 * n] = std::cos(n * beta);
    harmonics[2 * n + 1] = -std::sin(n * beta);
  }
  Eigen::Array3d r;
  for (int f = 0; f < 3; ++f) r[f] = (shares * sum_[f].middleRows<4>(first) * harmonics).value();
  return r;
}

Eigen::Matrix3d SlopeLags::PairsOnRings(const LagDensity& density, const Eigen::Vector2d& apart) const {
  const HankelLattice& lattice = HankelLattice::Shared();
  const double reach = density.reach() + apart.norm();
  const Eigen::Index count = directions_.cols();
  Eigen::Matrix3d pairs = Eigen::Matrix3d::Zero();
  double total = 0;
  // The density hardly varies over lags much shorter than its reach.
  const double even = 0.01 * density.reach();
  double at_centre = -1;
  for (Eigen::Index j = 0; j < on_rings_[0].rows(); ++j) {
    const double lag = lattice.Lag(static_cast<int>(j));
    if (lag > reach) break;
    // The first ring stands for the disc within it, too.
    const double steps = j == 0 ? 0.5 * lattice.step() + 0.5 : lattice.step();
    const double measure = 2 * std::numbers::pi * lag * lag * steps / static_cast<double>(count);
    for (Eigen::Index d = 0; d < count; ++d) {
      const Eigen::Vector2d at = lag * directions_.col(d);
      double here = at_centre;
      if (lag >= even || at_centre < 0) {
        here = density(at - apart);
        if (symmetric_ && !apart.isZero()) here = (here + density(at + apart)) / 2;
        if (lag < even) at_centre = here;
      }
      if (here == 0) continue;
      total += measure * here;
      pairs += measure * here * Products({on_rings_[0](j, d), on_rings_[1](j, d), on_rings_[2](j, d)});
    }
  }
  return total > 0 ? Eigen::Matrix3d(pairs / total) : Eigen::Matrix3d(Products(At({0, 0})));
}

Eigen::Matrix3d SlopeLags::MeanPairs(const LagDensity& density, const Eigen::Vector2d& apart) const {
  if (apart.norm() < 2 * density.reach()) return PairsOnRings(density, apart);
  Eigen::Matrix3d pairs = Eigen::Matrix3d::Zero();
  for (const LagDensity::Node& node : density.nodes()) pairs += node.weight * Products(At(apart + node.at));
  return pairs;
}

}  // namespace albtpu
