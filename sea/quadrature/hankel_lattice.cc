#include "sea/quadrature/hankel_lattice.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

#include "sea/spectra/harmonic_spectrum.h"

namespace albtpu {
namespace {

// Golub and Welsch (1969), doi:10.1090/S0025-5718-69-99647-1: for orthonormal polynomials with x p_n = b_n p_(n-1) +
// a_n p_n + b_(n+1) p_(n+1), the nodes are the eigenvalues of the matrix with the diagonal a_0, a_1, ... and b_1, b_2,
// ... beside it, and the weights, which add up to 1, the squares of the first elements of its eigenvectors.
std::vector<QuadratureNode> NodesOf(int count, double (*a)(double), double (*b)(double)) {
  Eigen::VectorXd elements(2 * count - 1);
  for (int n = 0; n < count; ++n) elements[n] = a(n);
  for (int n = 1; n < count; ++n) elements[count - 1 + n] = b(n);
  const double greatest = elements.cwiseAbs().maxCoeff(), scale = greatest == 0 ? 1 : greatest;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(elements.head(count) / scale, elements.tail(count - 1) / scale);
  std::vector<QuadratureNode> nodes;
  for (int i = 0; i < count; ++i) {
    nodes.push_back({scale * solver.eigenvalues()[i], std::pow(solver.eigenvectors()(0, i), 2)});
  }
  return nodes;
}

double Zero(double) { return 0; }

constexpr int kSamples = 16;       // of a step, for the means
constexpr double kFarthest = 400;  // beyond it, twenty radians a step, the means of Bessel functions are taken as 0
// Means below this are taken as 0: it is far below the last digit of a sum in single precision, and products of it with
// spectra do not become denormal numbers, which are slow.
constexpr double kLeast = 1e-14;
constexpr float kCounts = 1e-7F;  // means below this do not count

double OneMinusJ0(double x) {
  const double q = x * x / 4;
  return x < 0.1 ? q * (1 - q / 4 * (1 - q / 9)) : 1 - ::j0(x);
}

// The weight that cubic interpolation (Keys 1981, doi:10.1109/TASSP.1981.1163711) gives a sample `u` steps away.
double Share(double u) {
  u = std::abs(u);
  if (u < 1) return 1 + u * u * (1.5 * u - 2.5);
  return u < 2 ? 2 + u * (-4 + u * (2.5 - 0.5 * u)) : 0;
}

// The means of f(exp(u)) about u = start + i step, with the weight Share.
template <typename Function>
Eigen::ArrayXf Means(double start, double step, int count, const Function& f) {
  Eigen::ArrayXd fine((count + 3) * kSamples + 1);
  for (Eigen::Index i = 0; i < fine.size(); ++i)
    fine[i] = f(std::exp(start + step * (static_cast<double>(i) / kSamples - 2)));
  Eigen::ArrayXf means(count);
  for (int i = 0; i < count; ++i) {
    double sum = 0;
    for (int j = -2 * kSamples + 1; j < 2 * kSamples; ++j)
      sum += Share(static_cast<double>(j) / kSamples) * fine[(i + 2) * kSamples + j];
    means[i] = std::abs(sum) < kLeast * kSamples ? 0 : static_cast<float>(sum / kSamples);
  }
  return means;
}

}  // namespace

std::vector<QuadratureNode> GaussLegendre(int count, double begin, double end) {
  std::vector<QuadratureNode> nodes = NodesOf(count, Zero, [](double n) { return n / std::sqrt(4 * n * n - 1); });
  for (QuadratureNode& node : nodes) node = {begin + (end - begin) * (1 + node.at) / 2, (end - begin) * node.weight};
  return nodes;
}

std::vector<QuadratureNode> GaussHermite(int count) {
  return NodesOf(count, Zero, [](double n) { return std::sqrt(n); });
}

std::vector<QuadratureNode> GaussLaguerre(int count) {
  return NodesOf(
      count, [](double n) { return 2 * n + 1; }, [](double n) { return n; });
}

HankelLattice::HankelLattice(const std::vector<double>& wavenumbers)
    : wavenumbers_(Eigen::Map<const Eigen::ArrayXd>(wavenumbers.data(), wavenumbers.size())),
      step_(std::log(wavenumbers.back() / wavenumbers.front()) / (wavenumbers.size() - 1.0)) {
  const int count = size() + static_cast<int>(std::log(kLongestLag / kShortestLag) / step_) + 1;
  const double start = std::log(wavenumbers.front() * kShortestLag);
  for (int order = 0; order < kOrders; ++order) {
    bessel_.push_back(Means(start, step_, count, [order](double x) {
      if (x > kFarthest) return 0.0;
      return ::jn(order, x);
    }));
    const auto counts = [](float mean) { return std::abs(mean) > kCounts; };
    const Eigen::ArrayXf& means = bessel_.back();
    const auto first = std::find_if(means.begin(), means.end(), counts) - means.begin();
    const auto after =
        std::find_if(std::make_reverse_iterator(means.end()), std::make_reverse_iterator(means.begin()), counts);
    counting_.push_back({static_cast<int>(first), static_cast<int>(after.base() - means.begin())});
  }
  one_minus_bessel_ = Means(start, step_, count, [](double x) { return x > kFarthest ? 1.0 : OneMinusJ0(x); });
}

const HankelLattice& HankelLattice::Shared() {
  static const HankelLattice lattice(SeaWavenumbers());
  return lattice;
}

double HankelLattice::Lag(int j) const { return kShortestLag * std::exp(j * step_); }

double HankelLattice::IndexOfLag(double lag) const { return std::log(lag / kShortestLag) / step_; }

HankelLattice::Kernel HankelLattice::Bessel(int order, int first, int count, int stride) const {
  return KernelOf(bessel_[order], first, count, stride);
}

HankelLattice::Kernel HankelLattice::OneMinusBessel(int first, int count, int stride) const {
  return KernelOf(one_minus_bessel_, first, count, stride);
}

HankelLattice::Kernel HankelLattice::KernelOf(const Eigen::ArrayXf& means, int first, int count, int stride) const {
  assert(first >= 0 && first + (count - 1) * stride + size() <= means.size());
  return Kernel(means.data() + first, count, size(), Eigen::OuterStride<>(stride));
}

}  // namespace albtpu
