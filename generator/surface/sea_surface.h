// A random sea surface under a beam, from the longest wave down to the spacing of the grid.
//
// No single grid can hold the sea: at 15 m/s under a beam of 0.25 m it would need 20 000 points along a side. The
// spectrum is therefore divided by wavelength. Short waves form a periodic patch, made by FFT, a few times as wide as
// the beam. Long waves are plane waves, exact at any distance, evaluated where the beam meets the water and
// interpolated to the grid of the patch. Waves shorter than the grid are not drawn: see unresolved_waves.h.
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

// The resolution with which a sea is modelled under a beam; discretization.h chooses it.
struct Discretization {
  double patch_per_beam;        // side of the periodic patch, in widths of the beam on the water
  double points_per_footprint;  // grid points along the diameter of the footprint
  int rays;                     // of each beam
};

// Immutable. Serves beams of one footprint and profile, of all azimuths and all incidences up to the largest.
class SurfaceModel {
 public:
  // `widest` is the beam with the largest footprint on the water among those to be traced.
  SurfaceModel(const SeaState& sea, const BeamOptions& widest, const Discretization& discretization);

  const WavePatchModel& patch() const { return patch_; }
  const LongWaveModel& long_waves() const { return long_waves_; }

  // Covariance of the slopes of the surface's facets, with waves weighted by `weight(k, psi)`.
  Eigen::Matrix2d FacetSlopeCovariance(const std::function<double(double k, double psi)>& weight) const;

  // exp(i k_x x) and exp(i k_y y) for each wave of long_waves() (columns) at nodes about the centre of the local
  // surface (rows), as SumOfWaves takes them.
  const Eigen::MatrixXcd& phases_x() const { return phase_x_; }
  const Eigen::MatrixXcd& phases_y() const { return phase_y_; }
  // The matrix that interpolates from the nodes to the points of the local surface, with four nodes for each point.
  const Eigen::MatrixXd& refinement() const { return refine_; }

  HeightField StillSurface() const;                                      // the local grid over still water
  int local_points() const { return static_cast<int>(refine_.rows()); }  // along a side of the local surface

  double elevation_variance() const { return patch_.elevation_variance() + long_waves_.elevation_variance(); }

 private:
  friend class SeaSurface;

  WavePatchModel patch_;
  LongWaveModel long_waves_;
  Eigen::MatrixXd refine_;
  Eigen::MatrixXcd phase_x_, phase_y_;
};

// One realization, a function of (model, stream) alone. Immutable.
class SeaSurface {
 public:
  SeaSurface(const SurfaceModel& model, NormalStream stream);

  // The surface about the point where the axis of `beam` intersects the long waves, in coordinates about that point.
  // The patch of short waves is centred there. Because the patch is independent of the long waves and homogeneous, the
  // sum has the distribution of the whole sea.
  struct LocalSurface {
    HeightField heights;
    double elevation;  // of the point above the mean surface, m
  };
  LocalSurface SurfaceUnder(const Beam& beam) const;

 private:
  const SurfaceModel& model_;
  Eigen::VectorXcd long_amplitudes_;
  std::vector<double> patch_;
};

}  // namespace albtpu
