#include "generator/monte_carlo/height_slope_product.h"

#include <cassert>
#include <cmath>
#include <utility>

namespace albtpu {
namespace {

using Waves = Eigen::MatrixXcd;  // in the layout of ForwardFft

// The axes a and b of each of the three elements of a symmetric matrix.
constexpr std::array<std::pair<int, int>, 3> kElements = {{{0, 0}, {0, 1}, {1, 1}}};

// Wraps a function of the lag or the point (x, y), given at the element (x + reach, y + reach), onto a periodic grid.
Eigen::MatrixXd Wrapped(const Eigen::MatrixXd& centred, int size) {
  const int reach = static_cast<int>(centred.rows() - 1) / 2;
  const auto wrapped = [&](int lag) { return lag < 0 ? lag + size : lag; };
  Eigen::MatrixXd grid = Eigen::MatrixXd::Zero(size, size);
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) grid(wrapped(x), wrapped(y)) = centred(x + reach, y + reach);
  }
  return grid;
}

// The inverse of Wrapped, for the points about the centre.
Eigen::ArrayXXd Centred(const std::vector<double>& grid, int size, int reach) {
  const auto wrapped = [&](int lag) { return lag < 0 ? lag + size : lag; };
  Eigen::ArrayXXd centred(2 * reach + 1, 2 * reach + 1);
  for (int x = -reach; x <= reach; ++x) {
    const double* row = &grid[static_cast<std::size_t>(wrapped(x)) * size];
    for (int y = -reach; y <= reach; ++y) centred(x + reach, y + reach) = row[wrapped(y)];
  }
  return centred;
}

// The fraction of the beam's power that falls on each point's cell, by an even sample of the cell.
Eigen::MatrixXd Shares(const BeamOptions& beam, double spacing, int reach) {
  constexpr int kSamples = 5;  // a side
  const Eigen::Vector2d along(std::cos(beam.azimuth), std::sin(beam.azimuth)), across(-along.y(), along.x());
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(2 * reach + 1, 2 * reach + 1);
  for (int x = -reach; x <= reach; ++x) {
    for (int y = -reach; y <= reach; ++y) {
      for (int s = 0; s < kSamples * kSamples; ++s) {
        const Eigen::Vector2d within((s / kSamples + 0.5) / kSamples - 0.5,
                                     (s % kSamples + 0.5) / kSamples - 0.5);
        const Eigen::Vector2d at = spacing / beam.footprint * (Eigen::Vector2d(x, y) + within);
        const double squared_radius =
            std::pow(at.dot(along) * std::cos(beam.incidence), 2) + std::pow(at.dot(across), 2);
        shares(x + reach, y + reach) += RelativeIrradiance(beam.profile, squared_radius);
      }
    }
  }
  return shares / shares.sum();
}

// The sum over all modes, those not stored included, of `power` times `waves`, which transforms an even function.
double SumOver(const Eigen::MatrixXd& power, const Waves& waves) {
  const Eigen::Index last = waves.cols() - 1;
  const Eigen::MatrixXd each = power.cwiseProduct(waves.real());
  return 2 * each.sum() - each.col(0).sum() - each.col(last).sum();
}

}  // namespace

HeightSlopeProduct::HeightSlopeProduct(const SurfaceCorrelation& correlation, double spacing)
    : spacing_(spacing),
      reach_(correlation.reach() / 2),
      size_(FastSize(2 * correlation.reach() + 1)),
      transform_(size_) {
  const SurfaceCorrelation::AtPoints& at = correlation.at_points();
  const std::array<const Eigen::MatrixXd*, 2> height_slope = {&at.height_x, &at.height_y};
  const std::array<const Eigen::MatrixXd*, 3> slopes = {&at.slope_xx, &at.slope_xy, &at.slope_yy};
  height_ = Transform(at.height);
  for (const int a : {0, 1}) height_slope_[a] = Transform(*height_slope[a]);
  for (std::size_t e = 0; e < kElements.size(); ++e) {
    const auto [a, b] = kElements[e];
    slopes_[e] = Transform(*slopes[e]);
    products_[e] =
        Transform(at.height.cwiseProduct(*slopes[e]) - height_slope[a]->cwiseProduct(*height_slope[b]));
  }
}

Waves HeightSlopeProduct::Transform(const Eigen::MatrixXd& of_lags) const {
  return ForwardFft(Wrapped(of_lags, size_)) / (static_cast<double>(size_) * size_);
}

Eigen::Matrix2d HeightSlopeProduct::Covariance(const BeamOptions& beam) const {
  assert(std::isinf(beam.source_height));
  const Eigen::MatrixXd shares = Shares(beam, spacing_, reach_);
  const Waves footprint = ForwardFft(Wrapped(shares, size_));
  const Eigen::MatrixXd power = footprint.cwiseAbs2();
  const auto filtered = [&](const Waves& waves) {
    InverseFft::Modes modes = transform_.Allocate();
    for (Eigen::Index row = 0; row < waves.rows(); ++row) {
      for (Eigen::Index j = 0; j < waves.cols(); ++j) {
        // Conjugate: ForwardFft transforms a functional, and this is the transform of a function.
        modes[row * waves.cols() + j] = std::conj(waves(row, j)) * footprint(row, j);
      }
    }
    return Centred(transform_(std::move(modes)), size_, reach_);
  };
  const Eigen::ArrayXXd height = filtered(height_);
  const std::array<Eigen::ArrayXXd, 2> height_slope = {filtered(height_slope_[0]),
                                                       filtered(height_slope_[1])};
  std::array<double, 3> elements;
  for (std::size_t e = 0; e < kElements.size(); ++e) {
    const auto [a, b] = kElements[e];
    const double of_one =
        (shares.array() * (height * filtered(slopes_[e]) - height_slope[a] * height_slope[b])).sum();
    elements[e] =
        SumOver(power, products_[e]) - 2 * of_one + SumOver(power, height_) * SumOver(power, slopes_[e]);
  }
  return (Eigen::Matrix2d() << elements[0], elements[1], elements[1], elements[2]).finished();
}

}  // namespace albtpu
