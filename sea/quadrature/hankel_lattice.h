// The integrals of the response theory: Gaussian quadrature, and the lattice that takes a spectrum to lags.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace albtpu {

// Gaussian quadrature: the nodes and weights that integrate polynomials of the highest degree exactly.

struct QuadratureNode {
  double at, weight;
};

// `count` nodes on the interval from `begin` to `end`: exact up to degree 2 count - 1.
std::vector<QuadratureNode> GaussLegendre(int count, double begin, double end);

// The mean of a function of a standard normal variable is the sum of weight f(at): exact up to degree 2 count - 1.
std::vector<QuadratureNode> GaussHermite(int count);

// The integral of exp(-x) f(x) over positive x is the sum of weight f(at): exact up to degree 2 count - 1.
std::vector<QuadratureNode> GaussLaguerre(int count);

// Wavenumbers and lags in equal steps of the logarithm, and the Bessel functions that take a spectrum from one to the
// other. On such a lattice the function of wavenumber times lag depends on the sum of the two indices alone.
//
// Immutable; one serves all seas and beams.
class HankelLattice {
 public:
  static constexpr int kOrders = 20;            // J_0, J_1, ... J_19
  static constexpr double kShortestLag = 1e-3;  // m
  static constexpr double kLongestLag = 100;    // m

  // On the wavenumbers SeaWavenumbers().
  static const HankelLattice& Shared();

  int size() const { return static_cast<int>(wavenumbers_.size()); }
  const Eigen::ArrayXd& wavenumbers() const { return wavenumbers_; }  // rad/m
  double step() const { return step_; }                               // of ln k and of ln lag
  double Lag(int j) const;                                            // m
  double IndexOfLag(double lag) const;                                // the inverse, between lags too

  // The rows are lags, `stride` steps apart from the lag `first` on; the columns are wavenumbers. Elements are means of
  // J_order over the wavenumbers about k_i, with the weight that cubic interpolation in ln k gives to the sample there:
  // they vanish where a step is longer than a period. Single precision is enough, because no element loses digits.
  using Kernel =
      Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>, 0, Eigen::OuterStride<>>;
  Kernel Bessel(int order, int first, int count, int stride) const;
  // The sums of the indices of wavenumber and lag from the first to before the last where these elements count: the
  // others, together, are below 1e-7 of the sum over wavenumbers of the magnitude of what they multiply.
  struct Range {
    int first, last;
  };
  Range Counting(int order) const { return counting_[static_cast<std::size_t>(order)]; }
  // Of 1 - J_0, without cancellation at short lags.
  Kernel OneMinusBessel(int first, int count, int stride) const;

 private:
  explicit HankelLattice(const std::vector<double>& wavenumbers);
  Kernel KernelOf(const Eigen::ArrayXf& means, int first, int count, int stride) const;

  Eigen::ArrayXd wavenumbers_;
  double step_;
  std::vector<Eigen::ArrayXf> bessel_;  // by the sum of the indices of wavenumber and lag
  std::vector<Range> counting_;
  Eigen::ArrayXf one_minus_bessel_;
};

}  // namespace albtpu
