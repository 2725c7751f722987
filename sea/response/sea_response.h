// The response theory: the errors of any beam on any sea, from the spectrum alone.
//
// The mean refracted ray of a beam is a function of Gaussian waves. With the gains Gamma and the curvatures H_i of
// effective_gains.h, tau = tan(incidence) along the azimuth, the covariance R of the slopes at two points of the
// footprint, half the mean square D of the difference of their heights, <> the mean over these points and V = <R>, its
// covariance per depth^2 is
//     K_ij = [Gamma (V + <R tau tau^T R> + <D (tau . grad)^2 R>) Gamma^T]_ij + 1/2 <tr(H_i R H_j R)>
//            - <Gamma_i (tau . grad) R H_j grad D> - <Gamma_j (tau . grad) R H_i grad D>.
// "Finite slopes" in docs/physics.md derives it and states how well tracing agrees. Left out are terms of the sixth
// order in slope: of one ray, 0.02 % of THU and 0.14 % of TVU at a mean square slope of 0.15.
#pragma once

#include <vector>

#include "sea/response/beam_response.h"
#include "sea/response/beam_spectrum.h"
#include "sea/response/footprint.h"
#include "sea/response/footprint_kernel.h"

namespace albtpu {

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
