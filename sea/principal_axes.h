// The axes of the ellipse of a covariance in the plane.
#pragma once

#include <Eigen/Core>

namespace albtpu {

// The eigenvalues of a covariance, ascending, and its eigenvectors, one a column.
struct PrincipalAxes {
  Eigen::Vector2d variances;
  Eigen::Matrix2d directions;
};

PrincipalAxes PrincipalAxesOf(const Eigen::Matrix2d& covariance);

}  // namespace albtpu
