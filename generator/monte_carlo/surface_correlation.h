// Covariances of the heights and slopes of a surface between two points.
#pragma once

#include <Eigen/Core>

#include "generator/surface/sea_surface.h"

namespace albtpu {

// Covariances of heights and slopes as functions of the lag, for the waves of a SurfaceModel, all of which are
// stationary. Exact for the modes of the patch and for the plane waves. (A local surface holds an interpolation of the
// plane waves, whose slopes are accurate to 1e-3 or better.) Immutable.
class SurfaceCorrelation {
 public:
  // For lags up to `reach` cells along each axis; less than half the patch.
  SurfaceCorrelation(const SurfaceModel& model, int reach);

  int reach() const { return reach_; }

  // Of the slopes of two sides of triangles, by the lag in cells between their midpoints. Two sides along x are whole
  // cells apart, and so are two sides along y. A side along x and one along y are offset by half a cell on both axes:
  // xy is at the lag (lag_x + 1/2, lag_y + 1/2).
  double xx(int lag_x, int lag_y) const { return At(xx_, lag_x, lag_y); }
  double yy(int lag_x, int lag_y) const { return At(yy_, lag_x, lag_y); }
  double xy(int lag_x, int lag_y) const { return At(xy_, lag_x, lag_y); }

  // At the points of the grid, where the slope is that of a side centred on the point. The lag (i, j) is at the element
  // (i + reach(), j + reach()).
  struct AtPoints {
    // E[h(0) h(lag)] - E[h^2], m^2. Only differences of height matter within a footprint, and the variance of the long
    // waves would swamp them.
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
