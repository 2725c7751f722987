// How the heights and slopes of a surface go together from place to place.
#pragma once

#include <Eigen/Core>

#include "generator/surface/sea_surface.h"

namespace albtpu {

// Covariances of heights and slopes as functions of what lies between them, for the waves of a SurfaceModel,
// all of them stationary: exact for the modes of the patch and for the plane waves (of which the window holds
// an interpolation, right to 1e-3 of their own slopes and better). Immutable.
class SurfaceCorrelation {
 public:
  // For lags up to `reach` cells along each axis; less than half the patch.
  SurfaceCorrelation(const SurfaceModel& model, int reach);

  int reach() const { return reach_; }

  // Of the slopes of two sides of triangles, by what lies between their middles. Sides along x lie whole cells
  // apart from each other, and so do those along y; the one kind lies half a cell along both axes away from
  // the other: xy is at (lag_x + 1/2, lag_y + 1/2).
  double xx(int lag_x, int lag_y) const { return At(xx_, lag_x, lag_y); }
  double yy(int lag_x, int lag_y) const { return At(yy_, lag_x, lag_y); }
  double xy(int lag_x, int lag_y) const { return At(xy_, lag_x, lag_y); }

  // At the points of the grid, with the slope that a side about the point would have: at lag (i, j) in
  // (i + reach(), j + reach()).
  struct AtPoints {
    // E[h(0) h(lag)] - E[h^2]: only differences of height have a meaning under a footprint, and the heights
    // of long waves would swamp them. m^2.
    Eigen::MatrixXd height;
    Eigen::MatrixXd height_x, height_y;            // E[h(0) slope(lag)], m
    Eigen::MatrixXd slope_xx, slope_xy, slope_yy;  // E[slope(0) slope(lag)]
  };
  const AtPoints& at_points() const { return at_points_; }

 private:
  double At(const Eigen::MatrixXd& covariance, int lag_x, int lag_y) const {
    return covariance(lag_x + reach_, lag_y + reach_);
  }

  int reach_;
  Eigen::MatrixXd xx_, yy_, xy_;  // the lag along x is the row
  AtPoints at_points_;
};

}  // namespace albtpu
