#include "generator/monte_carlo/slope_moments.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <utility>

#include "generator/surface/ray_tracer.h"

namespace albtpu {
namespace {

// Adds the periodic `correlations` of the patch at the lags of `sum`.
void AddPatch(const std::vector<double>& correlations, int size, Eigen::MatrixXd& sum) {
  const int reach = static_cast<int>(sum.rows() - 1) / 2;
  const auto wrapped = [&](int lag) { return (lag % size + size) % size; };
  for (int x = -reach; x <= reach; ++x) {
    const double* row = &correlations[static_cast<std::size_t>(wrapped(x)) * size];
    for (int y = -reach; y <= reach; ++y) sum(x + reach, y + reach) += row[wrapped(y)];
  }
}

// exp(i phase lag) for each wave (columns) at the lags from -reach to reach (rows).
Eigen::MatrixXcd Phases(const Eigen::ArrayXd& phase_per_lag, int reach) {
  Eigen::MatrixXcd phases(2 * reach + 1, phase_per_lag.size());
  for (Eigen::Index m = 0; m < phases.cols(); ++m) {
    const std::complex<double> turn = std::polar(1.0, phase_per_lag[m]);
    phases(reach, m) = 1;
    for (int lag = 1; lag <= reach; ++lag) {
      phases(reach + lag, m) = phases(reach + lag - 1, m) * turn;
      phases(reach - lag, m) = std::conj(phases(reach + lag, m));
    }
  }
  return phases;
}

}  // namespace

SurfaceCorrelation::SurfaceCorrelation(const SurfaceModel& model, int reach) : reach_(reach) {
  assert(2 * reach < model.patch().size());
  const double spacing = model.patch().spacing();
  const std::vector<LongWaveModel::Wave>& waves = model.long_waves().waves();
  Eigen::ArrayX2d phase(waves.size(), 2);  // across one cell
  for (std::size_t m = 0; m < waves.size(); ++m) phase.row(m) = (spacing * waves[m].wavenumber).transpose().array();
  const Eigen::MatrixXcd x = Phases(phase.col(0), reach), y = Phases(phase.col(1), reach);
  const auto correlate = [&](const auto& factor) {
    Eigen::VectorXcd power(waves.size());
    for (std::size_t m = 0; m < waves.size(); ++m) power[m] = waves[m].variance * factor(phase(m, 0), phase(m, 1));
    Eigen::MatrixXd sum = SumOfWaves(x, power, y);
    AddPatch(model.patch().Correlate(factor), model.patch().size(), sum);
    return sum;
  };
  // The slope of a side for a wave of amplitude 1 is i times this quotient, a little less than the wavenumber.
  const auto quotient = [&](double phase_along) { return std::sin(phase_along / 2) * (2 / spacing); };
  using Complex = std::complex<double>;
  xx_ = correlate([&](double px, double) { return Complex(std::pow(quotient(px), 2)); });
  yy_ = correlate([&](double, double py) { return Complex(std::pow(quotient(py), 2)); });
  // At lags that are half a cell greater on both axes.
  xy_ = correlate([&](double px, double py) { return quotient(px) * quotient(py) * std::polar(1.0, (px + py) / 2); });

  at_points_.height = correlate([](double, double) { return Complex(1); });
  at_points_.height.array() -= at_points_.height(reach, reach);
  at_points_.height_x = correlate([&](double px, double) { return Complex(0, quotient(px)); });
  at_points_.height_y = correlate([&](double, double py) { return Complex(0, quotient(py)); });
  at_points_.slope_xx = xx_;
  at_points_.slope_xy = correlate([&](double px, double py) { return Complex(quotient(px) * quotient(py)); });
  at_points_.slope_yy = yy_;
}

namespace {

using Waves = Eigen::MatrixXcd;  // in the layout of ForwardFft

// The axes a and b of each of the three elements of a symmetric matrix.
constexpr std::array<std::pair<int, int>, 3> kElements = {{{0, 0}, {0, 1}, {1, 1}}};

// Wraps a function of the lag or the point (x, y), given at the element (x + reach, y + reach), onto a periodic grid.
Eigen::MatrixXd Wrapped(const Eigen::MatrixXd& centred, int size) {
  const int reach = static_cast<int>(centred.rows() - 1) / 2;
  const auto wrapped = [&](int lag) { return lag < 0 ? lag + size : lag; };
  Eigen::MatrixXd grid = Eigen::MatrixXd::Zero(size, size);
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) grid(wrapped(x), wrapped(y)) = centred(x + reach, y + reach);
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
        const Eigen::Vector2d within((s / kSamples + 0.5) / kSamples - 0.5, (s % kSamples + 0.5) / kSamples - 0.5);
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
    products_[e] = Transform(at.height.cwiseProduct(*slopes[e]) - height_slope[a]->cwiseProduct(*height_slope[b]));
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
  const std::array<Eigen::ArrayXXd, 2> height_slope = {filtered(height_slope_[0]), filtered(height_slope_[1])};
  std::array<double, 3> elements;
  for (std::size_t e = 0; e < kElements.size(); ++e) {
    const auto [a, b] = kElements[e];
    const double of_one = (shares.array() * (height * filtered(slopes_[e]) - height_slope[a] * height_slope[b])).sum();
    elements[e] = SumOver(power, products_[e]) - 2 * of_one + SumOver(power, height_) * SumOver(power, slopes_[e]);
  }
  return (Eigen::Matrix2d() << elements[0], elements[1], elements[1], elements[2]).finished();
}

namespace {

double FarthestOf(const std::vector<Ray>& rays) {
  double farthest = 0;
  for (const Ray& ray : rays) farthest = std::max(farthest, ray.at_zero.cwiseAbs().maxCoeff());
  return farthest;
}

// The fractions of the rays on the triangles of each kind (beside y, beside x), by cell, transformed on a grid of
// `size` cells.
std::array<Waves, 2> SharesOfTriangles(const std::vector<Ray>& rays, double spacing, int cells, int size) {
  const HeightField still(std::vector<double>(static_cast<std::size_t>(cells + 1) * (cells + 1), 0.0), cells + 1,
                          spacing);
  std::array<Eigen::MatrixXd, 2> shares = {Eigen::MatrixXd::Zero(size, size), Eigen::MatrixXd::Zero(size, size)};
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
    return (Eigen::Matrix2d() << covariance_[0], covariance_[1] / 2, covariance_[1] / 2, covariance_[2]).finished();
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
    return FootprintOverlap(beam.profile, std::hypot(lag.dot(along) * std::cos(beam.incidence), lag.dot(across)));
  };
  // The double integral of R over the footprint depends on the lag alone, with the footprint's overlap as the weight.
  double xx = 0, xy = 0, yy = 0, whole_weights = 0, half_weights = 0;
  for (int x = -correlation.reach(); x <= correlation.reach(); ++x) {
    for (int y = -correlation.reach(); y <= correlation.reach(); ++y) {
      const double whole = overlap(x, y), half = overlap(x + 0.5, y + 0.5);  // lags of whole and of half cells
      whole_weights += whole;
      half_weights += half;
      xx += whole * correlation.xx(x, y);
      yy += whole * correlation.yy(x, y);
      xy += half * correlation.xy(x, y);
    }
  }
  return (Eigen::Matrix2d() << xx / whole_weights, xy / half_weights, xy / half_weights, yy / whole_weights).finished();
}

int ReachOfRays(const std::vector<Ray>& rays, double spacing) {
  return static_cast<int>(2 * FarthestOf(rays) / spacing) + 3;
}

SlopeMoments MomentsOfSlopes(const SurfaceCorrelation& correlation, const std::vector<Ray>& rays, double spacing,
                             const Eigen::Matrix2d& form) {
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
  const std::vector<double> same_pairs = transform(std::move(same)), mixed_pairs = transform(std::move(mixed));

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
