// The response theory: the errors of any beam on any sea, from the spectrum alone.
//
// The mean refracted ray of a beam is a function of Gaussian waves. With the gains Gamma and the curvatures H_i of
// EffectiveGains (closed_form.h), tau = tan(incidence) along the azimuth, the covariance R of the slopes at two points
// of the footprint, half the mean square D of the difference of their heights, <> the mean over these points and V =
// <R>, its covariance per depth^2 is
//     K_ij = [Gamma (V + <R tau tau^T R> + <D (tau . grad)^2 R>) Gamma^T]_ij + 1/2 <tr(H_i R H_j R)>
//            - <Gamma_i (tau . grad) R H_j grad D> - <Gamma_j (tau . grad) R H_i grad D>.
// "Finite slopes" in docs/physics.md derives it and states how well tracing agrees. Left out are terms of the sixth
// order in slope: of one ray, 0.02 % of THU and 0.14 % of TVU at a mean square slope of 0.15.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sea/response/closed_form.h"
#include "sea/response/footprint_kernel.h"
#include "sea/response/slope_covariance.h"

namespace albtpu {

// The errors of the position that one beam reports over a sea, by the response theory.

// Errors are reported minus true, z up, and linear in the depth d below the mean height of the surface under the beam.
// docs/physics.md, section 1, defines them. x is downwind.
struct BeamResponse {
  // Of the error in (x, y, z) per metre of depth.
  Eigen::Matrix3d covariance_per_depth;
  // Of the error at the depth 0, m^2. The two parts are uncorrelated.
  Eigen::Matrix3d covariance_at_surface;
  Eigen::Vector3d mean_per_depth;  // of the error: the bias
  Eigen::Vector2d azimuth;         // unit vector of the beam's horizontal direction

  // 2 sigma of the angles between the mean refracted ray and that of still water, on x and on y, rad.
  double refraction_along_wind() const { return Refraction(0); }
  double refraction_cross_wind() const { return Refraction(1); }
  // In m, at a depth in m.
  Eigen::Matrix3d Covariance(double depth) const {
    return depth * depth * covariance_per_depth + covariance_at_surface;
  }
  double Thu(double depth) const;  // 2 sigma
  double Tvu(double depth) const;  // 2 sigma
  double BiasAlongBeam(double depth) const { return depth * azimuth.dot(mean_per_depth.head<2>()); }
  double BiasVertical(double depth) const { return depth * mean_per_depth.z(); }

 private:
  double Refraction(int axis) const;
};

// One sea. Immutable.
class SeaResponse {
 public:
  SeaResponse(const HarmonicSpectrum& spectrum, double refractive_index);

  // Of a collimated beam, 0.01 to 30 m wide.
  BeamResponse operator()(const BeamOptions& beam) const;

  // Of beams in one direction, one for each footprint.
  std::vector<BeamResponse> AlongDirection(double incidence, double azimuth,
                                           const std::vector<FootprintKernel>& footprints) const;

  const Eigen::Matrix2d& slope_covariance() const { return slopes_; }  // of all waves, x and y

 private:
  SlopeSpectrum spectrum_;
  double refractive_index_;
  Eigen::Matrix2d slopes_;
};

}  // namespace albtpu
