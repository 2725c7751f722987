#include "sea/principal_axes.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace albtpu {

// A matrix of 2 x 2 is tridiagonal, so that Eigen need not make it so: its code for that takes seconds to compile. As
// Eigen does it otherwise, the greatest element is scaled to 1.
PrincipalAxes PrincipalAxesOf(const Eigen::Matrix2d& covariance) {
  const Eigen::Vector2d diagonal = covariance.diagonal();
  const Eigen::Matrix<double, 1, 1> beside(covariance(1, 0));
  const double greatest = Eigen::Vector3d(diagonal[0], diagonal[1], beside[0]).cwiseAbs().maxCoeff();
  const double scale = greatest == 0 ? 1 : greatest;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeFromTridiagonal(diagonal / scale, beside / scale);
  return {solver.eigenvalues() * scale, solver.eigenvectors()};
}

}  // namespace albtpu
