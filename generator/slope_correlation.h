// How the slopes of the facets of a surface go together from place to place.
#pragma once

#include <Eigen/Core>

#include "generator/sea_surface.h"

namespace albtpu {

// The covariance of the slopes of two sides of triangles as a function of what lies between their middles,
// for the waves of a SurfaceModel, all of them stationary: exact for the modes of the patch and for the plane
// waves (of which the window holds an interpolation, right to 1e-3 of their own slopes and better).
// Immutable.
//
// Sides along x lie whole cells apart from each other, and so do those along y; the one kind lies half a cell
// along both axes away from the other.
class SlopeCorrelation {
 public:
  // For lags up to `reach` cells along each axis; less than half the patch.
  SlopeCorrelation(const SurfaceModel& model, int reach);

  int reach() const { return reach_; }
  double xx(int lag_x, int lag_y) const { return xx_(lag_x + reach_, lag_y + reach_); }
  double yy(int lag_x, int lag_y) const { return yy_(lag_x + reach_, lag_y + reach_); }
  // At (lag_x + 1/2, lag_y + 1/2).
  double xy(int lag_x, int lag_y) const { return xy_(lag_x + reach_, lag_y + reach_); }

 private:
  int reach_;
  Eigen::MatrixXd xx_, yy_, xy_;  // the lag along x is the row
};

}  // namespace albtpu
