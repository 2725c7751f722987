// A random sea surface under a beam, from the longest wave, as plane waves, down to the spacing of the grid.
//
// No single grid can hold the sea: at 15 m/s under a beam of 0.25 m it would need 20 000 points along a side. The
// spectrum is therefore divided by wavelength. Short waves form a periodic patch, made by FFT, a few times as wide as
// the beam. Long waves are plane waves, exact at any distance, evaluated where the beam meets the water and
// interpolated to the grid of the patch. Waves shorter than the grid are not drawn: see UnresolvedWaves
// (closed_form.h).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "generator/math/random_stream.h"
#include "generator/surface/beam.h"
#include "generator/surface/ray_tracer.h"
#include "generator/surface/wave_patch.h"
#include "sea/sea_state.h"

namespace albtpu {

// The waves that are longer than the patch under a beam, as plane waves, which need no grid.

// The part 1 - share(k) of a sea's spectrum, divided into rings and sectors of the half plane: twelve, and more in
// rings whose waves travel in a narrow range of directions, as swell does. Each cell becomes two plane waves with the
// cell's variances of elevation and slope and Gaussian amplitudes, so the sum is exactly Gaussian. Immutable.
class LongWaveModel {
 public:
  struct Wave {
    Eigen::Vector2d wavenumber;  // rad/m
    double variance;             // m^2
  };

  LongWaveModel(const SeaState& sea, const CrossFade& patch_share);

  const std::vector<Wave>& waves() const { return waves_; }
  double elevation_variance() const;
  Eigen::Matrix2d SlopeCovariance(const std::function<double(double k, double psi)>& weight) const;

  // Complex amplitudes A [m]: the elevation at x is the real part of the sum of A exp(i k . x).
  Eigen::VectorXcd Draw(NormalStream& stream) const;

  // The amplitudes of the same waves about another origin.
  Eigen::VectorXcd Shifted(const Eigen::VectorXcd& amplitudes, const Eigen::Vector2d& origin) const;

 private:
  std::vector<Wave> waves_;
};

// The sum of plane waves on a grid: the real part of phases_x diag(amplitudes) phases_y^T. The columns of `phases_x`
// are exp(i k_x x) of each wave at the grid's x (rows of the result), those of `phases_y` exp(i k_y y) (columns).
Eigen::MatrixXd SumOfWaves(const Eigen::MatrixXcd& phases_x, const Eigen::VectorXcd& amplitudes,
                           const Eigen::MatrixXcd& phases_y);

// The height z [m] at which the line through `at_zero + z * per_height` intersects the long waves. The line must be
// steeper than the waves, as every beam within 60 degrees of nadir is.
double HeightOfIntersection(const LongWaveModel& model, const Eigen::VectorXcd& amplitudes,
                            const Eigen::Vector2d& at_zero, const Eigen::Vector2d& per_height);

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
