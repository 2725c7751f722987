// The surface about one point in single precision, for all beams of a sea case: many realizations, fast.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "generator/kernels/fast_patch.h"
#include "generator/math/random_stream.h"
#include "generator/surface/sea_surface.h"

namespace albtpu {

// Draws the same waves as SeaSurface, about a point of the mean surface instead of the place where a beam
// meets them. A line with per_height p meets the long waves at places where they are as anywhere, but with
// the weight 1 - p . slope there (a slanted line meets the side that faces it more often): with that weight
// this is the law of SeaSurface's window, exactly, for every beam at once, as long as the line is steeper
// than the long waves. Immutable.
class FastSurface {
 public:
  explicit FastSurface(const SurfaceModel& model);

  int points() const { return points_; }  // along a side, odd
  float spacing() const { return spacing_; }

  // What one thread needs, used again from one realization to the next.
  struct Workspace {
    FastPatch::Workspace patch;
    std::vector<float> heights;  // m above the long waves at the centre; points() x points(), ix slow
    Eigen::Vector2d long_slope;  // of the long waves there
    Eigen::MatrixXf long_waves_of_row, long_waves_at_nodes;
    Eigen::MatrixXf refined;
  };
  void Draw(NormalStream stream, Workspace& workspace) const;

 private:
  // The four nodes, from `first` on, that a point of the window hangs on.
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
