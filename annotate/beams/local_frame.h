// A frame in metres around the middle of a file: what the geometry of neighbouring points is computed in.
#pragma once

#include <Eigen/Core>

namespace albtpu::annotate {

// x points to grid east, y to grid north, z up in the vertical datum of the points. Horizontal distances are true
// metres at the origin: the scale of a map projection is divided out.
struct LocalFrame {
  double origin_x = 0, origin_y = 0;  // In the horizontal unit of the points.
  double metres_per_x = 1, metres_per_y = 1;
  double metres_per_z = 1;  // Of the vertical unit.

  double X(double x) const { return (x - origin_x) * metres_per_x; }
  double Y(double y) const { return (y - origin_y) * metres_per_y; }
  double Z(double z) const { return z * metres_per_z; }
  Eigen::Vector3d At(double x, double y, double z) const { return {X(x), Y(y), Z(z)}; }
};

}  // namespace albtpu::annotate
