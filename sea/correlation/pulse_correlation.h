// The covariance of what the waves do to neighbouring pulses, and to their mean over a cell, of which
// correlated_pulses.h has the ratios. docs/surface.md derives it.
#pragma once

#include <Eigen/Core>
#include <array>

#include "sea/correlation/correlation.h"
#include "sea/correlation/moving_waves.h"
#include "sea/correlation/slope_lags.h"

namespace albtpu {

// The covariance of what the waves do to two pulses, or the variance of what they do to the mean over a cell.
struct SharedWaves {
  WaveCovariance footprint;  // of slopes (x and y) and heights, averaged over the footprint
  // Of the errors (x, y, z) of the reported points over a level bottom, per depth^2: the parts of first and of second
  // order in slope, which are uncorrelated. At nadir the vertical error has no part of first order.
  Eigen::Matrix3d first_order, second_order;

  Eigen::Matrix3d errors() const { return first_order + second_order; }
};

PulseCorrelation CorrelationOf(const SharedWaves& shared, const SharedWaves& pulse);

// One sea. Immutable.
class WaveCorrelation {
 public:
  explicit WaveCorrelation(const HarmonicSpectrum& spectrum, const WaveMotion& motion = {});

  const MovingWaves& waves() const { return waves_; }
  const FootprintWaves& points() const { return points_; }
  const SlopeLags& at_once() const { return at_once_; }      // lags at one instant
  const Eigen::Matrix2d& slopes() const { return slopes_; }  // the covariance of the slopes of all waves

 private:
  MovingWaves waves_;
  FootprintWaves points_;
  SlopeLags at_once_;
  Eigen::Matrix2d slopes_;
};

// The pulses of one beam, collimated, over one sea, which must outlive this. Immutable.
//
// The gains are those of EffectiveGains (closed_form.h). Of the terms of the fourth order in slope that the response
// theory has (sea_response.h), those that are squares of waves are here; what wave heights do to a slanted beam is not.
class BeamCorrelation {
 public:
  // A footprint of 0.01 to 10 m, an incidence of 0 to 30 degrees.
  BeamCorrelation(const WaveCorrelation& sea, const BeamOptions& beam, double refractive_index);

  const SharedWaves& pulse() const { return pulse_; }  // of a pulse with itself
  const FootprintWaves& waves() const { return waves_; }

  // With a pulse whose footprint lies `apart` [m, at most 60] from it on the water, `later` [s].
  SharedWaves Between(const Eigen::Vector2d& apart, double later) const;

  // Of two footprints with that covariance, as if these were short beside the waves: the second order goes with the
  // square of the slopes' covariance. Its correlation is right within 0.03 under 0.6 m, within 0.08 under 1.5 m.
  SharedWaves SharedNearly(const WaveCovariance& footprint) const;

  // Of the mean over a cell, of pulses that see the sea at one instant.
  SharedWaves InCell(const SurfaceCell& cell) const;

 private:
  SharedWaves SharedBy(const WaveCovariance& footprint, const Eigen::Matrix3d& pairs) const;

  const WaveCorrelation& sea_;
  BeamOptions beam_;
  FootprintWaves waves_;
  Eigen::Matrix<double, 3, 2> gain_;          // of the error (x, y, z) by the slope
  std::array<Eigen::Matrix2d, 3> curvature_;  // of each component of the error
  SharedWaves pulse_;
};

}  // namespace albtpu
