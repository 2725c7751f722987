#include "sea/response/slope_covariance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "sea/principal_axes.h"

namespace albtpu {
namespace {

// Harmonics that the stretching adds to those of the sea. Each is smaller than the one before by some
// tan^2(incidence) / 4, 0.05 at 25 degrees.
constexpr int kAddedHarmonics = 2;

}  // namespace

SlopeSpectrum::SlopeSpectrum(const HarmonicSpectrum& spectrum)
    : harmonics_(std::min<int>(spectrum.harmonics(), HankelLattice::kOrders / 2 - 1 - kAddedHarmonics)) {
  assert(spectrum.size() >= 2);
  const HankelLattice& lattice = HankelLattice::Shared();
  power_ = Eigen::MatrixXd::Zero(lattice.size(), 2 * harmonics_ + 1);
  std::size_t next = 0;  // the first sample above k
  for (int i = 0; i < lattice.size(); ++i) {
    const double k = lattice.wavenumbers()[i];
    while (next < spectrum.size() && spectrum.k[next] <= k) ++next;
    if (next == 0 || (next == spectrum.size() && spectrum.k.back() < k)) continue;
    const std::size_t after = std::min(next, spectrum.size() - 1), before = after - 1;
    const double fraction = (k - spectrum.k[before]) / (spectrum.k[after] - spectrum.k[before]);
    const double s_before = (1 - fraction) * spectrum.s[before], s_after = fraction * spectrum.s[after];
    const double scale = lattice.step() * k * k * k / (2 * std::numbers::pi);
    power_(i, 0) = scale * (s_before + s_after);
    for (int n = 1; n <= harmonics_; ++n) {
      const std::vector<double>&a = spectrum.a[n - 1], &b = spectrum.b[n - 1];
      power_(i, 2 * n - 1) = 2 * scale * (s_before * a[before] + s_after * a[after]);
      power_(i, 2 * n) = 2 * scale * (s_before * b[before] + s_after * b[after]);
    }
  }
}

Eigen::Matrix2d SlopeSpectrum::Covariance() const {
  const Eigen::VectorXd sums = power_.colwise().sum();
  const double half_trace = std::numbers::pi * sums[0];
  const double half_difference = std::numbers::pi / 2 * sums[1], xy = std::numbers::pi / 2 * sums[2];
  return (Eigen::Matrix2d() << half_trace + half_difference, xy, xy, half_trace - half_difference).finished();
}

BeamSpectrum SlopeSpectrum::AcrossBeam(double incidence, double azimuth) const {
  const Eigen::Index size = power_.rows();
  const int kept = harmonics_ + kAddedHarmonics;
  // Of half a turn. Harmonics that the stretching makes beyond four more than those of the sea alias: 1e-5 of them.
  const int directions = harmonics_ + kept + 5;
  const double cosine = std::cos(incidence);
  // exp(-2 i m psi) d(psi), and the density in kappa.
  Eigen::MatrixXcd transform(directions, kept + 1);
  Eigen::MatrixXd angles(2 * harmonics_ + 1, directions);
  Eigen::ArrayXd shift(directions);
  for (int j = 0; j < directions; ++j) {
    const double psi = std::numbers::pi * (j + 0.5) / directions;
    const double along = cosine * std::cos(psi), across = std::sin(psi);
    const double ratio = std::hypot(along, across);  // k / kappa
    shift[j] = -std::log(ratio) / HankelLattice::Shared().step();
    const double on_water = azimuth + std::atan2(across, along);
    angles(0, j) = 1;
    for (int n = 1; n <= harmonics_; ++n) {
      angles(2 * n - 1, j) = std::cos(2 * n * on_water);
      angles(2 * n, j) = std::sin(2 * n * on_water);
    }
    // P in d(ln kappa) d(psi) is cos(incidence) / ratio^2 times that in d(ln k) d(direction on the water), and
    // kappa^2 = k^2 / ratio^2.
    const double density = cosine / std::pow(ratio, 4) * 2 * std::numbers::pi / directions;
    for (int m = 0; m <= kept; ++m) transform(j, m) = std::polar(density, -2 * m * psi);
  }
  const Eigen::MatrixXd on_water = power_ * angles;
  Eigen::MatrixXd across_beam = Eigen::MatrixXd::Zero(size, directions);
  for (int j = 0; j < directions; ++j) {
    // Cubic interpolation between the four samples at k / kappa steps before.
    const int whole = static_cast<int>(shift[j]);
    const double t = shift[j] - whole;
    const double weights[] = {-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2, -(t + 1) * t * (t - 2) / 2,
                              (t + 1) * t * (t - 1) / 6};
    for (int i = 0; i < 4; ++i) {
      const Eigen::Index behind = whole + i - 1;
      const Eigen::Index to = std::max<Eigen::Index>(behind, 0), from = std::max<Eigen::Index>(-behind, 0);
      const Eigen::Index count = size - std::max(to, from);
      across_beam.col(j).segment(to, count) += weights[i] * on_water.col(j).segment(from, count);
    }
  }
  return {incidence, across_beam * transform};
}

namespace {

using Complex = std::complex<double>;

// Functions of the lag and its direction, as sums of harmonics: one row for each lag, one column for each direction.
class HarmonicSums {
 public:
  HarmonicSums(int functions, int lags, const Eigen::ArrayXd& directions)
      : directions_(directions), values_(functions, Eigen::MatrixXd::Zero(lags, directions.size())) {}

  // Adds the real part of factor (kernel spectrum) exp(i n beta) to the functions from `first` on.
  void Add(int n, double factor, const HankelLattice::Kernel& kernel, int first,
           const std::vector<Eigen::ArrayXcd>& spectra) {
    const auto count = static_cast<int>(spectra.size());
    Eigen::MatrixXf columns(kernel.cols(), 2 * count);
    for (int f = 0; f < count; ++f) {
      columns.col(2 * f) = spectra[f].real().cast<float>();
      columns.col(2 * f + 1) = spectra[f].imag().cast<float>();
    }
    const Eigen::MatrixXd sums = (kernel * columns).eval().cast<double>();
    Eigen::MatrixXd turns(2, directions_.size());
    turns << factor * (n * directions_).cos().transpose(), -factor * (n * directions_).sin().transpose();
    for (int f = 0; f < count; ++f) values_[first + f].noalias() += sums.middleCols(2 * f, 2) * turns;
  }

  const Eigen::MatrixXd& operator[](int function) const { return values_[function]; }

 private:
  const Eigen::ArrayXd& directions_;
  std::vector<Eigen::MatrixXd> values_;
};

}  // namespace

LagCovariances::LagCovariances(const BeamSpectrum& spectrum, int lags) {
  constexpr int kStride = FootprintKernel::kLagStride;
  const HankelLattice& lattice = HankelLattice::Shared();
  const int last = spectrum.harmonics();
  const Eigen::Index count = 2 * last + 3;
  directions = (Eigen::ArrayXd::LinSpaced(count, 0, static_cast<double>(count - 1)) + 0.5) *
               (std::numbers::pi / static_cast<double>(count));
  const Eigen::ArrayXd k = lattice.wavenumbers();
  const auto harmonic = [&](int m) -> Eigen::ArrayXcd {
    if (m > last) return Eigen::ArrayXcd::Zero(lattice.size());
    return m < 0 ? Eigen::ArrayXcd(spectrum.slope.col(-m).conjugate()) : spectrum.slope.col(m);
  };
  HarmonicSums even(4, lags, directions), odd(2, lags, directions);
  for (int l = 0; l <= last; ++l) {
    const Eigen::ArrayXcd same = harmonic(l), before = harmonic(l - 1), after = harmonic(l + 1);
    // R_xx + R_yy has the harmonic `same`, R_xx - R_yy that of cos(2 psi), R_xy half that of sin(2 psi).
    const Eigen::ArrayXcd difference = (before + after) / 2;
    std::vector<Eigen::ArrayXcd> spectra = {(same + difference) / 2, (before - after) * Complex(0, -0.25),
                                            (same - difference) / 2};
    const HankelLattice::Kernel kernel = lattice.Bessel(2 * l, 0, lags, kStride);
    const double sign = l % 2 == 0 ? 1 : -1;
    if (l == 0) {
      even.Add(0, 1, kernel, 0, spectra);
      even.Add(0, 1, lattice.OneMinusBessel(0, lags, kStride), 3, {same / k.square()});
    } else {  // the harmonic -l is the conjugate
      spectra.push_back(-same / k.square());
      even.Add(2 * l, 2 * sign, kernel, 0, spectra);
    }
    odd.Add(2 * l + 1, 2 * sign, lattice.Bessel(2 * l + 1, 0, lags, kStride), 0,
            {(same + after) / (2 * k), (same - after) * Complex(0, -1) / (2 * k)});
  }
  along = even[0];
  both = even[1];
  across = even[2];
  height = even[3];
  Eigen::VectorXd lag(lags);
  for (int j = 0; j < lags; ++j) lag[j] = lattice.Lag(j * kStride);
  height_along = lag.asDiagonal() * odd[0];
  height_across = lag.asDiagonal() * odd[1];
}

LagProducts::LagProducts(const LagCovariances& r) {
  const Eigen::Index lags = r.height.rows();
  const Eigen::ArrayXXd* slope[] = {&r.along, &r.both, &r.across};
  const Eigen::ArrayXXd* gradient[] = {&r.height_along, &r.height_across};
  const Eigen::VectorXd mean =
      Eigen::VectorXd::Constant(r.directions.size(), 1.0 / static_cast<double>(r.directions.size()));
  const Eigen::VectorXd cosine = mean.array() * r.directions.cos();
  const Eigen::VectorXd turned = mean.array() * (2 * r.directions).cos();

  slope_pairs.resize(lags, 6);
  for (int a = 0, pair = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b) slope_pairs.col(pair++) = (*slope[a] * *slope[b]).matrix() * mean;
  Eigen::MatrixXd normals(r.directions.size(), 3);
  normals << mean.array() * r.directions.cos().square(), mean.array() * (r.directions.cos() * r.directions.sin()),
      mean.array() * r.directions.sin().square();
  squared_heights = r.height.square().matrix() * normals;
  slopes.resize(lags, 3);
  turned_slopes = height_slopes = turned_height_slopes = slopes;
  gradient_slopes.resize(lags, 6);
  for (int a = 0; a < 3; ++a) {
    const Eigen::MatrixXd product = *slope[a] * r.height;
    slopes.col(a) = slope[a]->matrix() * mean;
    turned_slopes.col(a) = slope[a]->matrix() * turned;
    height_slopes.col(a) = product * mean;
    turned_height_slopes.col(a) = product * turned;
    for (int c = 0; c < 2; ++c) gradient_slopes.col(3 * c + a) = (*slope[a] * *gradient[c]).matrix() * cosine;
  }
}

namespace {

// The second derivatives d_xx, d_xy and d_yy of the square of f, of which a ring has the part that is added: by the
// harmonics of f on the ring and of its derivative by ln s.
Eigen::Array3d RingOfSquare(const Eigen::VectorXcd& f, const Eigen::VectorXcd& slope) {
  // The means over a turn of f^2 and f^2 exp(2 i beta).
  double mean_slope = 2 * f[0].real() * slope[0].real();
  Complex turned = 0, turned_slope = 0;
  for (Eigen::Index l = 0; l + 1 < f.size(); ++l) {
    mean_slope += 4 * (std::conj(f[l + 1]) * slope[l + 1]).real();
    turned += 2.0 * f[l] * std::conj(f[l + 1]);
    turned_slope += 2.0 * (slope[l] * std::conj(f[l + 1]) + f[l] * std::conj(slope[l + 1]));
  }
  const Complex difference = 2.0 * turned + turned_slope;  // d_xx - d_yy + 2 i d_xy
  return {(mean_slope + difference.real()) / 2, difference.imag() / 2, (mean_slope - difference.real()) / 2};
}

}  // namespace

Eigen::Matrix2d HeightSlopeCovariance(const BeamSpectrum& spectrum, const LagProducts& products,
                                      const FootprintKernel& footprint) {
  const auto squares = products.squared_heights.topRows(footprint.overlap().size());
  const Eigen::Array3d on_edge = squares.transpose() * footprint.overlap_edge().matrix();
  const double difference = on_edge[0] - on_edge[2];
  const Eigen::Array3d of_pairs = Eigen::Array3d(difference, 2 * on_edge[1], -difference) +
                                  Eigen::Array3d(squares.transpose() * footprint.overlap_edge_slope().matrix());

  Eigen::Array3d of_points = Eigen::Array3d::Zero();
  const Eigen::Index harmonics = spectrum.slope.cols();
  for (const SpectrumRing& ring : footprint.irradiance_rings()) {
    const auto at = [&](const Eigen::MatrixXd& kernel) {
      return Eigen::VectorXcd(kernel.leftCols(harmonics).cwiseProduct(spectrum.slope).colwise().sum().transpose());
    };
    of_points += ring.weight * RingOfSquare(at(ring.value), at(ring.slope));
  }

  const double cosine = std::cos(spectrum.incidence);
  const Eigen::Array3d sum = (of_points - 0.5 * of_pairs) * Eigen::Array3d(cosine * cosine, cosine, 1);
  const Eigen::Matrix2d covariance = (Eigen::Matrix2d() << sum[0], sum[1], sum[1], sum[2]).finished() -
                                     HeightDifference(spectrum, footprint) * FootprintSlopes(spectrum, footprint);
  // Under long waves the three means cancel to within the errors of their quadrature.
  const PrincipalAxes axes = PrincipalAxesOf(covariance);
  return axes.directions * axes.variances.cwiseMax(0).asDiagonal() * axes.directions.transpose();
}

namespace {

// Of R_ab in the order of SlopePairs.
int Element(int a, int b) { return a + b; }

}  // namespace

Eigen::Matrix2d FootprintSlopes(const BeamSpectrum& spectrum, const FootprintKernel& footprint) {
  const Eigen::VectorXcd sums = spectrum.slope.leftCols(2).transpose() * footprint.average().square().matrix();
  const double cosine = std::cos(spectrum.incidence);
  const double along = 0.5 * (sums[0] + sums[1]).real() * cosine * cosine;
  const double across = 0.5 * (sums[0] - sums[1]).real(), both = -0.5 * sums[1].imag() * cosine;
  return (Eigen::Matrix2d() << along, both, both, across).finished();
}

double HeightDifference(const BeamSpectrum& spectrum, const FootprintKernel& footprint) {
  const auto squares = HankelLattice::Shared().wavenumbers().square();
  return (spectrum.slope.col(0).real().array() / squares * (1 - footprint.average().square())).sum();
}

Eigen::Matrix3d SlopePairs(const LagProducts& products, double incidence, const FootprintKernel& footprint) {
  const Eigen::Index lags = footprint.overlap().size();
  const Eigen::VectorXd sums = products.slope_pairs.topRows(lags).transpose() * footprint.overlap().matrix();
  Eigen::Matrix3d pairs;
  pairs << sums[0], sums[1], sums[2],  //
      sums[1], sums[3], sums[4],       //
      sums[2], sums[4], sums[5];
  // A slope along the azimuth is cos(incidence) times that across the beam.
  const double cosine = std::cos(incidence);
  const Eigen::Vector3d scale(cosine * cosine, cosine, 1);
  return scale.asDiagonal() * pairs * scale.asDiagonal();
}

double MeanOfForms(const Eigen::Matrix2d& g, const Eigen::Matrix2d& h, const Eigen::Matrix3d& pairs) {
  double sum = 0;
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < 2; ++b) {
      for (int c = 0; c < 2; ++c)
        for (int d = 0; d < 2; ++d) sum += g(a, b) * h(c, d) * pairs(Element(b, c), Element(d, a));
    }
  }
  return sum;
}

}  // namespace albtpu
