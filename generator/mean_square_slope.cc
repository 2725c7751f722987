#include "generator/mean_square_slope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <tuple>
#include <utility>

#include "generator/forward_fft.h"
#include "generator/inverse_fft.h"

namespace albtpu {
namespace {

using Waves = Eigen::MatrixXcd;  // as ForwardFft gives them

// What one of the two triangles of a cell makes of a wave exp(i k . x) about its low corner: its slope along x or y.
WavePatchModel::Filter FacetSlope(bool beside_x, int axis, double spacing) {
  return [=](double kx, double ky) {
    const std::complex<double> over_x = std::polar(1.0, kx * spacing), over_y = std::polar(1.0, ky * spacing);
    const std::complex<double> rise = (axis == 0 ? over_x : over_y) - 1.0;
    const bool from_corner = (axis == 0) == beside_x;  // else from the end of the other side
    return rise / spacing * (from_corner ? 1.0 : axis == 0 ? over_y : over_x);
  };
}

// The shares of the rays that each triangle of a kind meets, by its cell in the window.
Eigen::MatrixXd Shares(const SurfaceModel& model, const std::vector<Ray>& rays, bool beside_x) {
  const HeightField still = model.StillWindow();
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(still.points() - 1, still.points() - 1);
  for (const Ray& ray : rays) {
    const HeightField::Triangle triangle = still.TriangleAt(ray.at_zero);
    if (triangle.beside_x == beside_x) shares(triangle.ix, triangle.iy) += 1.0 / rays.size();
  }
  return shares;
}

// sum_x a(x) b(x + lag) at all lags, from the transforms of a and b.
std::vector<double> CrossCorrelation(const Waves& a, const Waves& b, int size) {
  const InverseFft transform(size);
  InverseFft::Modes modes = transform.Allocate();
  const double points = static_cast<double>(size) * size;
  for (int row = 0; row < size; ++row) {
    for (int j = 0; j <= size / 2; ++j) {
      modes[row * (size / 2 + 1) + j] = a(row, j) * std::conj(b(row, j)) / points;
    }
  }
  return transform(std::move(modes));
}

// The mean over `shares` (of both kinds of triangles, by cell of the window, the cell along x the row) of the squared
// slopes along x and y of each plane wave as the window has it, over its amplitude squared.
Eigen::MatrixX2d SquaredSlopes(const SurfaceModel& model, const std::array<Eigen::MatrixXd, 2>& shares) {
  const auto [x, y] = model.LongWavesAtPoints();
  const Eigen::Index cells = x.rows() - 1;
  const auto low = [&](const Eigen::MatrixXcd& wave) { return wave.topRows(cells).cwiseAbs2(); };
  const auto high = [&](const Eigen::MatrixXcd& wave) { return wave.bottomRows(cells).cwiseAbs2(); };
  const auto rise = [&](const Eigen::MatrixXcd& wave) {
    return ((wave.bottomRows(cells) - wave.topRows(cells)) / model.patch().spacing()).cwiseAbs2();
  };
  const auto mean = [](const Eigen::MatrixXd& over_x, const Eigen::MatrixXd& weights,
                       const Eigen::MatrixXd& over_y) {
    return Eigen::VectorXd(over_x.cwiseProduct(weights * over_y).colwise().sum().transpose());
  };
  Eigen::MatrixX2d squares(x.cols(), 2);
  squares.col(0) = mean(rise(x), shares[1], low(y)) + mean(rise(x), shares[0], high(y));
  squares.col(1) = mean(high(x), shares[1], rise(y)) + mean(low(x), shares[0], rise(y));
  return squares;
}

// Where in its cell, from the low corner and in cells, the side of a triangle has its middle that gives its slope along
// `axis`.
Eigen::Vector2d MiddleOfSide(bool beside_x, int axis) {
  const double across = (axis == 0) == beside_x ? 0 : 1;
  return axis == 0 ? Eigen::Vector2d(0.5, across) : Eigen::Vector2d(across, 0.5);
}

// The slopes of the long waves, taken as stationary.
class LongSlopes {
 public:
  LongSlopes(const SurfaceModel& model, const Eigen::MatrixX2d& squared_slopes, int reach)
      : along_x_(2 * reach + 1, squared_slopes.rows()),
        along_y_(2 * reach + 1, squared_slopes.rows()),
        per_cell_(squared_slopes.rows(), 2) {
    const std::vector<LongWaveModel::Wave>& waves = model.long_waves().waves();
    for (std::vector<double>& power : power_) power.resize(waves.size());
    for (std::size_t m = 0; m < waves.size(); ++m) {
      const Eigen::Vector2d per_cell = waves[m].wavenumber * model.patch().spacing();
      per_cell_.row(m) = per_cell.transpose();
      for (int lag = -reach; lag <= reach; ++lag) {
        along_x_(lag + reach, m) = std::polar(1.0, per_cell.x() * lag);
        along_y_(lag + reach, m) = std::polar(1.0, per_cell.y() * lag);
      }
      const double xx = squared_slopes(m, 0), yy = squared_slopes(m, 1);
      power_[0][m] = waves[m].variance * xx;
      power_[1][m] = waves[m].variance * std::copysign(std::sqrt(xx * yy), per_cell.x() * per_cell.y());
      power_[2][m] = waves[m].variance * yy;
    }
  }

  // The covariance of the slope along `a` and of that along `b`, `offset` and a lag of whole cells away; the lag
  // along x is the row, from -reach.
  Eigen::MatrixXd Correlation(int a, int b, const Eigen::Vector2d& offset) const {
    Eigen::VectorXcd power(per_cell_.rows());
    for (Eigen::Index m = 0; m < power.size(); ++m) {
      power[m] = std::polar(1.0, per_cell_.row(m).dot(offset)) * power_[a + b][m];
    }
    const Eigen::MatrixXcd weighted = along_x_ * power.asDiagonal();
    return weighted.real() * along_y_.real().transpose() - weighted.imag() * along_y_.imag().transpose();
  }

 private:
  Eigen::MatrixXcd along_x_, along_y_;        // exp(i k lag), lags the rows and waves the columns
  Eigen::MatrixX2d per_cell_;                 // wavenumbers, rad
  std::array<std::vector<double>, 3> power_;  // of the slopes: xx, xy, yy
};

}  // namespace

MeanSquareSlopeMoments MomentsOfMeanSquareSlope(const SurfaceModel& model, const std::vector<Ray>& rays) {
  const int size = model.patch().size();
  const double spacing = model.patch().spacing();
  double widest = 0;
  for (const Ray& ray : rays) widest = std::max(widest, ray.at_zero.cwiseAbs().maxCoeff());
  const int reach = std::min(static_cast<int>(2 * widest / spacing) + 2, size / 2 - 1);
  const std::array<Eigen::MatrixXd, 2> shares = {Shares(model, rays, false), Shares(model, rays, true)};
  const std::array<Waves, 2> transformed = {ForwardFft(model.patch().Folded(shares[0])),
                                            ForwardFft(model.patch().Folded(shares[1]))};
  const Eigen::MatrixX2d squared_slopes = SquaredSlopes(model, shares);
  const LongSlopes long_slopes(model, squared_slopes, reach);
  double sum = 0;
  for (const auto& [first, second, times] : {std::tuple(0, 0, 1), std::tuple(1, 1, 1), std::tuple(0, 1, 2)}) {
    const std::vector<double> pairs = CrossCorrelation(transformed[first], transformed[second], size);
    for (const int a : {0, 1}) {
      for (const int b : {0, 1}) {
        const std::vector<double> patch_slopes = model.patch().Correlation(
            FacetSlope(first == 1, a, spacing), FacetSlope(second == 1, b, spacing));
        const Eigen::MatrixXd long_covariances =
            long_slopes.Correlation(a, b, MiddleOfSide(second == 1, b) - MiddleOfSide(first == 1, a));
        for (int x = -reach; x <= reach; ++x) {
          for (int y = -reach; y <= reach; ++y) {
            const std::size_t lag = static_cast<std::size_t>((x + size) % size) * size + (y + size) % size;
            const double covariance = patch_slopes[lag] + long_covariances(x + reach, y + reach);
            sum += times * pairs[lag] * covariance * covariance;
          }
        }
      }
    }
  }
  double mean = model.patch().FacetSlopeCovariance([](double, double) { return 1.0; }).trace();
  for (Eigen::Index m = 0; m < squared_slopes.rows(); ++m) {
    mean += model.long_waves().waves()[m].variance * squared_slopes.row(m).sum();
  }
  return {mean, 2 * sum};
}

}  // namespace albtpu
