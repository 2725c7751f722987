// A random sea surface under a beam, from its longest wave to the spacing of its grid.
//
// One grid cannot hold the sea: 15 m/s under a beam of 0.25 m would want 20 000 points a side. The spectrum
// is shared out by wavelength. Short waves are a periodic patch by FFT, some times as wide as the beam; long
// ones are plane waves, exact at any distance, evaluated where the beam meets the water and interpolated on
// the grid of the patch. Waves shorter than the grid are not drawn: see unresolved_waves.h.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "generator/surface/beam.h"
#include "generator/surface/height_field.h"
#include "generator/surface/long_waves.h"
#include "generator/surface/wave_patch.h"
#include "sea/sea_state.h"

namespace albtpu {

// How finely a sea is modelled under a beam; discretization.h chooses it.
struct Discretization {
  double patch_per_beam;        // side of the periodic patch, in widths of the beam on the water
  double points_per_footprint;  // grid points along the diameter of the footprint
  int rays;                     // of each beam
};

// Immutable, for beams of one footprint and profile, of all incidences up to the greatest and all azimuths.
class SurfaceModel {
 public:
  // `widest` is the beam with the greatest footprint on the water among those to be traced.
  SurfaceModel(const SeaState& sea, const BeamOptions& widest, const Discretization& discretization);

  const WavePatchModel& patch() const { return patch_; }
  const LongWaveModel& long_waves() const { return long_waves_; }

  // Covariance of the slopes of the facets of the surface, waves weighted by `weight(k, psi)`.
  Eigen::Matrix2d FacetSlopeCovariance(const std::function<double(double k, double psi)>& weight) const;

  // exp(i k x) and exp(i k y) for each wave of long_waves() (columns) at nodes about the centre of the window
  // (rows): their product is the wave. And the matrix that takes values at nodes to the points of the window:
  // four nodes to a point.
  const Eigen::MatrixXcd& phases_x() const { return phase_x_; }
  const Eigen::MatrixXcd& phases_y() const { return phase_y_; }
  const Eigen::MatrixXd& refinement() const { return refine_; }

  HeightField StillSurface() const;                                      // the window's grid over still water
  int local_points() const { return static_cast<int>(refine_.rows()); }  // along a side

  double elevation_variance() const { return patch_.elevation_variance() + long_waves_.elevation_variance(); }

 private:
  friend class SeaSurface;

  WavePatchModel patch_;
  LongWaveModel long_waves_;
  Eigen::MatrixXd refine_;  // from values at the nodes of the long waves to the points of the window
  Eigen::MatrixXcd phase_x_, phase_y_;  // exp(i k x) at the nodes (rows) for each wave (columns)
};

// One realization: a function of (model, stream) alone. Immutable.
class SeaSurface {
 public:
  SeaSurface(const SurfaceModel& model, NormalStream stream);

  // The surface about the point where the axis of `beam` meets the long waves, in coordinates about that
  // point. The patch of short waves is laid with its centre there: it is independent of the long waves and
  // alike everywhere, so the law of the sum is that of the whole sea.
  struct LocalSurface {
    HeightField heights;
    double elevation;  // m, of the point above the mean surface
  };
  LocalSurface SurfaceUnder(const Beam& beam) const;

 private:
  const SurfaceModel& model_;
  Eigen::VectorXcd long_amplitudes_;
  std::vector<double> patch_;
};

}  // namespace albtpu
