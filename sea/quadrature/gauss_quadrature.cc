#include "sea/quadrature/gauss_quadrature.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace albtpu {
namespace {

// Golub and Welsch (1969), doi:10.1090/S0025-5718-69-99647-1: for orthonormal polynomials with x p_n = b_n p_(n-1) +
// a_n p_n + b_(n+1) p_(n+1), the nodes are the eigenvalues of the matrix with the diagonal a_0, a_1, ... and b_1, b_2,
// ... beside it, and the weights, which add up to 1, the squares of the first elements of its eigenvectors.
template <typename Diagonal, typename Beside>
std::vector<QuadratureNode> NodesOf(int count, const Diagonal& a, const Beside& b) {
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(count, count);
  for (int n = 0; n < count; ++n) jacobi(n, n) = a(n);
  for (int n = 1; n < count; ++n) jacobi(n, n - 1) = b(n);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(jacobi);
  std::vector<QuadratureNode> nodes;
  for (int i = 0; i < count; ++i) {
    nodes.push_back({solver.eigenvalues()[i], std::pow(solver.eigenvectors()(0, i), 2)});
  }
  return nodes;
}

double Zero(double) { return 0; }

}  // namespace

std::vector<QuadratureNode> GaussLegendre(int count, double begin, double end) {
  std::vector<QuadratureNode> nodes =
      NodesOf(count, Zero, [](double n) { return n / std::sqrt(4 * n * n - 1); });
  for (QuadratureNode& node : nodes) {
    node = {begin + (end - begin) * (1 + node.at) / 2, (end - begin) * node.weight};
  }
  return nodes;
}

std::vector<QuadratureNode> GaussHermite(int count) {
  return NodesOf(count, Zero, [](double n) { return std::sqrt(n); });
}

std::vector<QuadratureNode> GaussLaguerre(int count) {
  return NodesOf(
      count, [](double n) { return 2 * n + 1; }, [](double n) { return n; });
}

}  // namespace albtpu
