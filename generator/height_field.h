// A triangulated piece of sea surface, and where a ray meets it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "generator/beam.h"

namespace albtpu {

// Elevations on a square grid about the origin, each cell cut into two triangles along the diagonal from its
// low corner to its high corner. That is a Delaunay triangulation of the grid's points. Immutable.
class HeightField {
 public:
  // `heights` [m] at ((ix - centre) spacing, (iy - centre) spacing), ix slow, with centre = (points - 1) / 2;
  // `points` along a side, odd, at least 3.
  HeightField(std::vector<double> heights, int points, double spacing);

  // A triangle as the plane height_at_origin + slope . (x, y).
  struct Facet {
    double height_at_origin;  // m
    Eigen::Vector2d slope;
    double HeightAt(const Eigen::Vector2d& x) const { return height_at_origin + slope.dot(x); }
  };
  // The triangle over or under `x`. The planes of the outermost cells go on beyond the edge.
  Facet FacetAt(const Eigen::Vector2d& x) const;

  double reach() const { return (points_ - 1) / 2 * spacing_; }  // m from the centre to each side
  double spacing() const { return spacing_; }                    // m

 private:
  std::vector<double> heights_;
  int points_;
  double spacing_;
};

// Where a ray meets a surface.
struct Hit {
  double height;  // m
  HeightField::Facet facet;
};

// The meeting of `ray` and `surface`: exact, on the plane of one triangle. The height of the ray above the
// surface grows steadily upward as long as no facet turns away from the ray, which takes a slope of 1 /
// tan(incidence), 2.1 at 25 degrees: then the meeting is the only one.
Hit Intersect(const HeightField& surface, const Ray& ray);

}  // namespace albtpu
