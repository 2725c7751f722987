#include "sea/response/lag_covariances.h"

#include "sea/response/footprint_kernel.h"

namespace albtpu {
namespace {

Eigen::ArrayXf Float(const Eigen::ArrayXd& column) { return column.cast<float>(); }

}  // namespace

LagCovariances::LagCovariances(const BeamSpectrum& spectrum, int lags) {
  const HankelLattice& lattice = HankelLattice::Shared();
  const int last = spectrum.harmonics();
  trace.resize(lags, last + 1);
  difference = difference_of_negative = height = trace;
  const auto harmonic = [&](int m) -> Eigen::ArrayXcd {
    if (m > last) return Eigen::ArrayXcd::Zero(lattice.size());
    return m < 0 ? Eigen::ArrayXcd(spectrum.slope.col(-m).conjugate()) : spectrum.slope.col(m);
  };
  Eigen::MatrixXf columns(lattice.size(), 8), sums(lags, 8);
  for (int l = 0; l <= last; ++l) {
    const Eigen::ArrayXcd same = harmonic(l), before = harmonic(l - 1), after = harmonic(l + 1).conjugate();
    const Eigen::ArrayXcd elevation = -same / lattice.wavenumbers().square();
    columns << Float(same.real()), Float(same.imag()), Float(before.real()), Float(before.imag()),
        Float(after.real()), Float(after.imag()), Float(elevation.real()), Float(elevation.imag());
    if (l % 2 == 1) columns = -columns;
    sums.noalias() = lattice.Bessel(l, 0, lags, FootprintKernel::kLagStride) * columns;
    if (l == 0) {
      sums.rightCols(2).noalias() =
          -lattice.OneMinusBessel(0, lags, FootprintKernel::kLagStride) * columns.rightCols(2);
    }
    const auto sum = [&](int c) {
      Eigen::VectorXcd pair(lags);
      pair.real() = sums.col(c).cast<double>();
      pair.imag() = sums.col(c + 1).cast<double>();
      return pair;
    };
    trace.col(l) = sum(0);
    difference.col(l) = sum(2);
    difference_of_negative.col(l) = sum(4);
    height.col(l) = sum(6);
  }
}

LagProducts ProductsOf(const LagCovariances& r) {
  LagProducts products = LagProducts::Zero(r.trace.rows(), 6);
  for (Eigen::Index l = 0; l < r.trace.cols(); ++l) {
    const Eigen::ArrayXcd t = r.trace.col(l), z = r.difference.col(l),
                          negative = r.difference_of_negative.col(l);
    const double both = l == 0 ? 1 : 2;  // l and -l
    products.col(0).array() += both * t.abs2();
    products.col(1).array() += l == 0 ? z.abs2() : Eigen::ArrayXd(z.abs2() + negative.abs2());
    Eigen::ArrayXcd tz = t.conjugate() * z;
    if (l > 0) tz += t * negative;
    const Eigen::ArrayXcd zz = both * z * negative;
    products.col(2).array() += tz.real();
    products.col(3).array() += tz.imag();
    products.col(4).array() += zz.real();
    products.col(5).array() += zz.imag();
  }
  return products;
}

}  // namespace albtpu
