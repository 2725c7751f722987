// The sea surface about one point in single precision, for all beams of a sea case. Its slow twin is SeaSurface.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "generator/kernels/fast_patch.h"
#include "generator/math/random_stream.h"
#include "generator/surface/sea_surface.h"

namespace albtpu {

// Draws the same waves as SeaSurface, but about a fixed point of the mean surface and not about the point where a beam
// meets the water. Weighted by 1 - p . slope, with the slope of the long waves at that point, these surfaces have
// exactly the distribution of SeaSurface::SurfaceUnder for a beam with per_height p.
//
// Derivation: the line x = x0 + z p intersects the long waves eta at the point y = x0 + eta(y) p. The sea is
// homogeneous, so an expectation over the surfaces about y, for a fixed line, is a mean over x0. The Jacobian
// determinant of x0 = y - eta(y) p is 1 - p . grad eta(y); in the mean over y it is the weight. It is positive, and y
// is unique, as long as the line is steeper than the long waves. A slanted line meets the side that faces it more
// often.
//
// One surface thus serves all beams of a sea case. Immutable.
class FastSurface {
 public:
  explicit FastSurface(const SurfaceModel& model);

  int points() const { return points_; }  // along a side, odd
  float spacing() const { return spacing_; }

  // The memory of one thread, reused from one realization to the next.
  struct Workspace {
    FastPatch::Workspace patch;
    std::vector<float> heights;  // m above the long waves at the centre; points() x points(), ix slow
    Eigen::Vector2d long_slope;  // of the long waves at the centre
    Eigen::MatrixXf long_waves_of_row, long_waves_at_nodes;
    Eigen::MatrixXf refined;
  };
  void Draw(NormalStream stream, Workspace& workspace) const;

 private:
  // A point is interpolated from four nodes, beginning with `first`.
  struct Cubic {
    int first;
    std::array<float, 4> weights;
  };

  LongWaveModel long_waves_;
  FastPatch patch_;
  int points_;
  float spacing_;
  std::vector<Cubic> cubics_;      // along a side
  Eigen::MatrixXcf phases_x_;      // nodes x waves
  Eigen::MatrixXf cos_and_sin_y_;  // 2 waves x nodes
};

}  // namespace albtpu
