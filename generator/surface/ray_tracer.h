// A beam through one piece of sea surface: the triangles of the surface, where rays meet them, and how they are
// refracted.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "generator/surface/beam.h"
#include "sea/response/closed_form.h"

namespace albtpu {

// A triangulated piece of sea surface and its intersection with a ray.

// Elevations on a square grid about the origin. The diagonal from the low corner (smallest x and y) to the high corner
// divides each cell into two triangles, which is a Delaunay triangulation of the grid's points. Immutable.
class HeightField {
 public:
  // `heights` [m] at ((ix - centre) spacing, (iy - centre) spacing), ix slow, with centre = (points - 1) / 2;
  // `points` along a side, odd, at least 3.
  HeightField(std::vector<double> heights, int points, double spacing);

  // One of the two triangles of a cell.
  struct Triangle {
    int ix, iy;     // the low corner of the cell
    bool beside_x;  // the triangle with the side from the low corner along x
    bool operator==(const Triangle&) const = default;
  };
  // The triangle above or below `x`. Beyond the edge of the grid, a triangle of the nearest outermost cell.
  Triangle TriangleAt(const Eigen::Vector2d& x) const {
    const double last_cell = points_ - 2;
    const Eigen::Vector2d at = (x * points_per_metre_).array() + (points_ - 1) / 2;
    const int ix = static_cast<int>(std::clamp(at.x(), 0.0, last_cell));
    const int iy = static_cast<int>(std::clamp(at.y(), 0.0, last_cell));
    return {ix, iy, at.x() - ix > at.y() - iy};
  }

  // The plane of a triangle, height_at_origin + slope . (x, y).
  struct Facet {
    double height_at_origin;  // m
    Eigen::Vector2d slope;
    double HeightAt(const Eigen::Vector2d& x) const { return height_at_origin + slope.dot(x); }
  };
  Facet FacetOf(const Triangle& triangle) const;
  Facet FacetAt(const Eigen::Vector2d& x) const { return FacetOf(TriangleAt(x)); }

  const std::vector<double>& heights() const { return heights_; }  // m, as given
  int points() const { return points_; }                           // along a side
  double reach() const { return (points_ - 1) / 2 * spacing_; }    // m from the centre to each side
  double spacing() const { return spacing_; }                      // m

 private:
  std::vector<double> heights_;
  int points_;
  double spacing_, points_per_metre_;
};

// A height field in single precision in memory that it does not own.
struct HeightView {
  const float* heights;   // m, at ((ix - centre) spacing, (iy - centre) spacing), ix slow
  int points;             // along a side, odd, at least 3
  std::ptrdiff_t stride;  // floats from one row to the next, at least `points`
  float spacing;          // m

  HeightField::Triangle TriangleAt(const Eigen::Vector2d& x) const;
  HeightField::Facet FacetOf(const HeightField::Triangle& triangle) const;
  double reach() const { return (points - 1) / 2 * static_cast<double>(spacing); }
};

// The point where a ray intersects a surface.
struct Hit {
  double height;  // m
  HeightField::Facet facet;
};

// The exact intersection of `ray` and `surface`, on the plane of one triangle. It is unique as long as no facet turns
// away from the ray, because the ray's height above the surface then increases monotonically with z. A facet turns
// away at a slope of 1 / tan(incidence), which is 2.1 at 25 degrees.
Hit Intersect(const HeightField& surface, const Ray& ray);
Hit Intersect(const HeightView& surface, const Ray& ray);

// Means over the rays of a beam. Rays are straight below the surface, so these means give the centroid and the mean
// path exactly at every depth. Let h be the height of a ray's intersection above the mean of all intersections. At the
// depth d below that mean, the centroid has moved by `height_tangent + d tangent`, and the mean path length is
// `height_secant + d secant`.
struct TracedBeam {
  Eigen::Vector2d tangent;         // horizontal distance per unit of depth, of the refracted ray
  Eigen::Vector2d height_tangent;  // mean of h times the tangent, m
  double secant;                   // path length per unit of depth
  double height_secant;            // mean of h times the secant, m
  Eigen::Vector2d slope;           // of the facets that the rays intersect
  Eigen::Vector3d slope_squares;   // SlopeSquares of these facets
};

// `rays` are in the coordinates of `surface`.
TracedBeam Trace(const std::vector<Ray>& rays, const HeightField& surface, double refractive_index);

// The same beam with the mean effect of waves shorter than the grid of the surface.
TracedBeam WithUnresolvedWaves(TracedBeam beam, const UnresolvedWaves& unresolved);

}  // namespace albtpu
