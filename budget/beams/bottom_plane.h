// The plane of least squares through points of the bottom, from sums that add up over the cells of a grid.
#pragma once

#include <Eigen/Core>

namespace albtpu {

// Sums over points, from which the plane of least squares follows; x, y and z from the middle of a cell, m.
struct PlaneSums {
  double n = 0, x = 0, y = 0, z = 0, xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;

  void Add(double dx, double dy, double dz, double weight = 1);
  // The same about a point that lies (dx, dy) from the origin.
  PlaneSums About(double dx, double dy) const;
  PlaneSums& operator+=(const PlaneSums& other);
};

struct Plane {
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  // The covariance of the slope, if heights have the variance 1.
  Eigen::Matrix2d of_unit_noise = Eigen::Matrix2d::Zero();
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  // The mean of its points, m from the middle of the cell.
  bool has_slope = false;
};

// Level where the points lie on a line or close together, so that they do not tell a slope. `side` of a cell, m; points
// are of 3 x 3 such cells at least.
Plane PlaneOf(const PlaneSums& sums, double side);

}  // namespace albtpu
