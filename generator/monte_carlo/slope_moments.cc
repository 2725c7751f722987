#include "generator/monte_carlo/slope_moments.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "generator/math/fft.h"
#include "generator/surface/height_field.h"

namespace albtpu {
namespace {

using Waves = Eigen::MatrixXcd;  // in the layout of ForwardFft

double FarthestOf(const std::vector<Ray>& rays) {
  double farthest = 0;
  for (const Ray& ray : rays) farthest = std::max(farthest, ray.at_zero.cwiseAbs().maxCoeff());
  return farthest;
}

// The fractions of the rays on the triangles of each kind (beside y, beside x), by cell, transformed on a grid of
// `size` cells.
std::array<Waves, 2> SharesOfTriangles(const std::vector<Ray>& rays, double spacing, int cells, int size) {
  const HeightField still(std::vector<double>(static_cast<std::size_t>(cells + 1) * (cells + 1), 0.0),
                          cells + 1, spacing);
  std::array<Eigen::MatrixXd, 2> shares = {Eigen::MatrixXd::Zero(size, size),
                                           Eigen::MatrixXd::Zero(size, size)};
  for (const Ray& ray : rays) {
    const HeightField::Triangle triangle = still.TriangleAt(ray.at_zero);
    shares[triangle.beside_x](triangle.ix, triangle.iy) += 1.0 / static_cast<double>(rays.size());
  }
  return {ForwardFft(shares[0]), ForwardFft(shares[1])};
}

// Accumulates the covariance matrices R of pairs of slopes: R itself for the covariance of the means, and
// tr(form R form R^T) for the variance of the form.
class Sums {
 public:
  explicit Sums(const Eigen::Matrix2d& form) : form_(form) {}

  void Add(double pairs, double xx, double xy, double yx, double yy) {
    covariance_[0] += pairs * xx;
    covariance_[1] += pairs * (xy + yx);
    covariance_[2] += pairs * yy;
    const double a = form_(0, 0), b = form_(0, 1), c = form_(1, 1);
    // The elements of form R,
    const double p = a * xx + b * yx, q = a * xy + b * yy, r = b * xx + c * yx, s = b * xy + c * yy;
    // and of form R^T.
    const double t = a * xx + b * xy, u = a * yx + b * yy, v = b * xx + c * xy, w = b * yx + c * yy;
    form_squares_ += pairs * (p * t + q * v + r * u + s * w);
  }

  Eigen::Matrix2d covariance() const {
    return (Eigen::Matrix2d() << covariance_[0], covariance_[1] / 2, covariance_[1] / 2, covariance_[2])
        .finished();
  }
  double variance_of_form() const { return 2 * form_squares_; }

 private:
  Eigen::Matrix2d form_;
  std::array<double, 3> covariance_ = {};
  double form_squares_ = 0;
};

}  // namespace

Eigen::Matrix2d FootprintSlopeCovariance(const SurfaceCorrelation& correlation, const BeamOptions& beam,
                                         double spacing) {
  const Eigen::Vector2d along(std::cos(beam.azimuth), std::sin(beam.azimuth)), across(-along.y(), along.x());
  const auto overlap = [&](double x, double y) {
    const Eigen::Vector2d lag = spacing / beam.footprint * Eigen::Vector2d(x, y);
    return FootprintOverlap(beam.profile,
                            std::hypot(lag.dot(along) * std::cos(beam.incidence), lag.dot(across)));
  };
  // The double integral of R over the footprint depends on the lag alone, with the footprint's overlap as the weight.
  double xx = 0, xy = 0, yy = 0, whole_weights = 0, half_weights = 0;
  for (int x = -correlation.reach(); x <= correlation.reach(); ++x) {
    for (int y = -correlation.reach(); y <= correlation.reach(); ++y) {
      const double whole = overlap(x, y),
                   half = overlap(x + 0.5, y + 0.5);  // lags of whole and of half cells
      whole_weights += whole;
      half_weights += half;
      xx += whole * correlation.xx(x, y);
      yy += whole * correlation.yy(x, y);
      xy += half * correlation.xy(x, y);
    }
  }
  return (Eigen::Matrix2d() << xx / whole_weights, xy / half_weights, xy / half_weights, yy / whole_weights)
      .finished();
}

int ReachOfRays(const std::vector<Ray>& rays, double spacing) {
  return static_cast<int>(2 * FarthestOf(rays) / spacing) + 3;
}

SlopeMoments MomentsOfSlopes(const SurfaceCorrelation& correlation, const std::vector<Ray>& rays,
                             double spacing, const Eigen::Matrix2d& form) {
  const int cells = 2 * (static_cast<int>(FarthestOf(rays) / spacing) + 1);
  const int reach = cells - 1;  // the largest lag between two cells
  assert(reach + 1 <= correlation.reach());
  const int size = FastSize(2 * cells);
  const auto [beside_y, beside_x] = SharesOfTriangles(rays, spacing, cells, size);

  // The number of pairs of rays at each lag, divided by the squared number of rays: pairs on triangles of the same
  // kind, and pairs on one triangle of each kind.
  const InverseFft transform(size);
  InverseFft::Modes same = transform.Allocate(), mixed = transform.Allocate();
  const double points = static_cast<double>(size) * size;
  for (int row = 0; row < size; ++row) {
    for (int j = 0; j <= size / 2; ++j) {
      const std::complex<double> x = beside_x(row, j), y = beside_y(row, j);
      same[row * (size / 2 + 1) + j] = (std::norm(x) + std::norm(y)) / points;
      mixed[row * (size / 2 + 1) + j] = y * std::conj(x) / points;
    }
  }
  const std::vector<double> same_pairs = transform(std::move(same)),
                            mixed_pairs = transform(std::move(mixed));

  Sums sums(form);
  const SurfaceCorrelation& r = correlation;
  const auto wrapped = [&](int lag) { return lag < 0 ? lag + size : lag; };
  for (int x = -reach; x <= reach; ++x) {
    for (int y = -reach; y <= reach; ++y) {
      const std::size_t lag = static_cast<std::size_t>(wrapped(x)) * size + wrapped(y);
      // For two triangles beside y, the two mixed covariances change places, which gives the same sums.
      sums.Add(same_pairs[lag], r.xx(x, y), r.xy(x, y), r.xy(x - 1, y - 1), r.yy(x, y));
      // From a triangle beside y to one beside x, and the reverse.
      sums.Add(2 * mixed_pairs[lag], r.xx(x, y - 1), r.xy(x, y - 1), r.xy(x, y - 1), r.yy(x + 1, y));
    }
  }
  // Within a triangle, the midpoints of the two sides are half a cell apart along both axes.
  return {sums.covariance(), {r.xx(0, 0), r.yy(0, 0), r.xy(0, 0)}, sums.variance_of_form()};
}

}  // namespace albtpu
