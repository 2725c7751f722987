// The points of a cell about the plane of the bottom around it: which take part, and the node that they make.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "budget/beams/bottom_plane.h"
#include "quality/surface/node.h"
#include "quality/surface/surface_point.h"

namespace albtpu::quality {

// Of one number or more, which it puts into another order.
double MedianOf(std::vector<double>& values);

// The points of a cell and their places, m from its middle. `kept` says which take part.
struct CellPoints {
  std::span<const SurfacePoint> points;
  std::span<const Eigen::Vector2d> places;
};

// Takes those out of `kept` that lie beyond kFarthest standard deviations of the median about a plane. Of fewer than
// three points nobody knows which is wrong.
void LeaveOutFar(const CellPoints& cell, const Plane& plane, std::span<char> kept);

// At the middle of the cell, of the points that are kept; without points where none is. What lines share of it is put
// into `lines`, if given.
SurfaceNode NodeOf(const CellPoints& cell, std::span<const char> kept, const Plane& plane, const NodeSources& sources,
                   std::vector<LineOfNode>* lines = nullptr);

// A node of the points within `radius` m of `x` and `y`, of which `points`, in the order of SurfacePoint::Order, has
// them all and no others: a circle in place of a square cell. Mean and plane are of the same points. `sources` are for
// cells of SideOfCircle(radius). No node where no plane is known.
SurfaceNode NodeOfCircle(std::span<const SurfacePoint> points, double x, double y, double radius,
                         double metres_per_unit, const NodeSources& sources, std::vector<LineOfNode>& lines);

// The side of the square cell with the area of a circle, m.
double SideOfCircle(double radius);

}  // namespace albtpu::quality
