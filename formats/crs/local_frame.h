// A frame in metres around the middle of a file: what the geometry of neighbouring points is computed in.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "formats/crs/map_frame.h"

namespace albtpu::formats {

// x points to grid east, y to grid north, z up in the vertical datum of the points. Horizontal distances are true
// metres at the origin: the scale of a map projection is divided out.
struct LocalFrame {
  double origin_x = 0, origin_y = 0;  // In the horizontal unit of the points.
  double metres_per_x = 1, metres_per_y = 1;
  double metres_per_z = 1;  // Of the vertical unit.
  double north_per_x = 0;   // As of MapMetric.
  double turn = 0;          // Of longitudes, in which x repeats; 0 on a map.
  // True azimuth = grid azimuth + convergence: rad at the origin, and rad per metre along x and y. It is about
  // (longitude - central meridian) sin(latitude): 15 km from the origin, a straight line leaves 1e-5 rad of it out.
  double convergence = 0;
  Eigen::Vector2d convergence_slope = Eigen::Vector2d::Zero();

  // x - from; of longitudes, the short way round.
  double Difference(double x, double from) const { return DifferenceOfX(x, from, turn); }

  // m to grid east and grid north of the origin.
  Eigen::Vector2d At(double x, double y) const {
    const double dx = Difference(x, origin_x);
    return {dx * metres_per_x, (y - origin_y) * metres_per_y + dx * north_per_x};
  }
  Eigen::Vector3d At(double x, double y, double z) const {
    const Eigen::Vector2d at = At(x, y);
    return {at.x(), at.y(), Z(z)};
  }
  double Z(double z) const { return z * metres_per_z; }

  // The inverse of At; longitudes lie within half a turn of the origin.
  MapPosition MapOf(double east, double north) const {
    const double dx = east / metres_per_x;
    return {origin_x + dx, origin_y + (north - dx * north_per_x) / metres_per_y};
  }

  // rad, at a point in metres from the origin.
  double ConvergenceAt(const Eigen::Vector2d& at) const { return convergence + convergence_slope.dot(at); }
};

// The frame around `middle`, of a file with heights in units of `metres_per_z`. Absent where `map` is not defined.
std::optional<LocalFrame> FrameAround(const MapPosition& middle, const MapFrame& map, double metres_per_z);

}  // namespace albtpu::formats
