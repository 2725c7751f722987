#include "sea/response/lag_covariances.h"

#include <complex>
#include <numbers>
#include <vector>

#include "sea/response/footprint_kernel.h"

namespace albtpu {
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
  for (int a = 0, pair = 0; a < 3; ++a) {
    for (int b = a; b < 3; ++b) slope_pairs.col(pair++) = (*slope[a] * *slope[b]).matrix() * mean;
  }
  Eigen::MatrixXd normals(r.directions.size(), 3);
  normals << mean.array() * r.directions.cos().square(),
      mean.array() * (r.directions.cos() * r.directions.sin()), mean.array() * r.directions.sin().square();
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

}  // namespace albtpu
