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

// The shares of the rays that each triangle of a kind meets, by its cell, on the periodic patch.
Eigen::MatrixXd Shares(const SurfaceModel& model, const std::vector<Ray>& rays, bool beside_x) {
  const int points = model.window_points(), size = model.patch().size();
  const HeightField grid(std::vector<double>(static_cast<std::size_t>(points) * points, 0.0), points,
                         model.patch().spacing());
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(size, size);
  for (const Ray& ray : rays) {
    const HeightField::Triangle triangle = grid.TriangleAt(ray.at_zero);
    if (triangle.beside_x == beside_x) shares(triangle.ix % size, triangle.iy % size) += 1.0 / rays.size();
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

// The covariances xx, xy and yy of the slopes of the long waves at lags of up to `reach` cells, lag along x the row.
std::array<Eigen::MatrixXd, 3> LongSlopeCorrelation(const LongWaveModel& long_waves, double spacing,
                                                    int reach) {
  const auto count = static_cast<Eigen::Index>(long_waves.waves().size());
  Eigen::MatrixXcd along_x(2 * reach + 1, count), along_y(2 * reach + 1, count);
  std::array<Eigen::VectorXd, 3> power = {Eigen::VectorXd(count), Eigen::VectorXd(count),
                                          Eigen::VectorXd(count)};
  for (Eigen::Index m = 0; m < count; ++m) {
    const LongWaveModel::Wave& wave = long_waves.waves()[m];
    const double kx = wave.wavenumber.x(), ky = wave.wavenumber.y();
    for (int lag = -reach; lag <= reach; ++lag) {
      along_x(lag + reach, m) = std::polar(1.0, kx * lag * spacing);
      along_y(lag + reach, m) = std::polar(1.0, ky * lag * spacing);
    }
    power[0][m] = wave.variance * kx * kx;
    power[1][m] = wave.variance * kx * ky;
    power[2][m] = wave.variance * ky * ky;
  }
  std::array<Eigen::MatrixXd, 3> correlation;
  for (int c = 0; c < 3; ++c) {
    correlation[c] = along_x.real() * power[c].asDiagonal() * along_y.real().transpose() -
                     along_x.imag() * power[c].asDiagonal() * along_y.imag().transpose();
  }
  return correlation;
}

}  // namespace

MeanSquareSlopeMoments MomentsOfMeanSquareSlope(const SurfaceModel& model, const std::vector<Ray>& rays) {
  const int size = model.patch().size();
  const double spacing = model.patch().spacing();
  double widest = 0;
  for (const Ray& ray : rays) widest = std::max(widest, ray.at_zero.cwiseAbs().maxCoeff());
  const int reach = std::min(static_cast<int>(2 * widest / spacing) + 2, size / 2 - 1);
  const auto long_slopes = LongSlopeCorrelation(model.long_waves(), spacing, reach);
  const std::array<Waves, 2> shares = {ForwardFft(Shares(model, rays, false)),
                                       ForwardFft(Shares(model, rays, true))};
  double sum = 0;
  for (const auto& [first, second, times] : {std::tuple(0, 0, 1), std::tuple(1, 1, 1), std::tuple(0, 1, 2)}) {
    const std::vector<double> pairs = CrossCorrelation(shares[first], shares[second], size);
    for (const int a : {0, 1}) {
      for (const int b : {0, 1}) {
        const std::vector<double> patch_slopes = model.patch().Correlation(
            FacetSlope(first == 1, a, spacing), FacetSlope(second == 1, b, spacing));
        for (int x = -reach; x <= reach; ++x) {
          for (int y = -reach; y <= reach; ++y) {
            const std::size_t lag = static_cast<std::size_t>((x + size) % size) * size + (y + size) % size;
            const double covariance = patch_slopes[lag] + long_slopes[a + b](x + reach, y + reach);
            sum += times * pairs[lag] * covariance * covariance;
          }
        }
      }
    }
  }
  return {model.FacetSlopeCovariance([](double, double) { return 1.0; }).trace(), 2 * sum};
}

}  // namespace albtpu
