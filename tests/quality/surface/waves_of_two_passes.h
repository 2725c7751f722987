// What two passes of one line share of the waves, by theory. Nodes take passes as independent.
//
// The fore part of a scan sees the waves seconds before the aft part, whose beams enter the water metres away where
// both meet the same bottom. Long waves are still there.
#pragma once

#include <Eigen/Core>
#include <span>

#include "quality/surface/surface_point.h"
#include "sea/correlation/moving_waves.h"
#include "sea/spectra/harmonic_spectrum.h"

namespace albtpu::quality {

class WavesOfTwoPasses {
 public:
  // x of `sea` is east. `upward` takes the error of a point to one of the height at a fixed place.
  WavesOfTwoPasses(const HarmonicSpectrum& sea, double footprint, double index, const Eigen::Vector3d& upward);

  // Of the mean of points in SurfacePoint::Order: what its variance has beyond that of independent passes, m^2. First
  // order in slope.
  double VarianceOf(std::span<const SurfacePoint> points) const;

 private:
  double Covariance(const SurfacePoint& one, const SurfacePoint& other) const;
  Eigen::RowVector2d GainOf(const SurfacePoint& point) const;  // Of the error at a fixed place by slope.
  Eigen::Vector2d EntryOf(const SurfacePoint& point) const;    // Where its beam enters the water.

  FootprintWaves waves_;
  Eigen::Matrix2d slopes_;
  double index_;
  Eigen::Vector3d upward_;
};

}  // namespace albtpu::quality
