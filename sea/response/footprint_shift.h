// The effect of wave heights on the mean slope under a slanted beam: they shift each ray along the azimuth.
#pragma once

#include <Eigen/Core>
#include <array>

#include "sea/response/footprint_kernel.h"
#include "sea/response/slope_covariance.h"

namespace albtpu {

// With x along the azimuth, R the covariance of the slopes at two points of the footprint, D half the mean square of
// the difference of their heights, and <> the mean over the two points. Both vanish under a footprint that is short
// beside the waves, where all rays shift alike. Without unit.
struct FootprintShift {
  Eigen::Matrix2d spread;                // <D d_x d_x R_ab>
  std::array<Eigen::Matrix2d, 2> drift;  // [c]: <d_c D d_x R_ab>
};

// `pairs` is SlopePairs() of the same arguments.
//
// Derivation: R_ab is d_a d_b D. By partial integration, with a the overlap of the footprint,
//     <d_c D d_x R_ab>  = integral of a d_x (d_c D R_ab) - <R_cx R_ab>,
//     <D d_x d_x R_ab>  = integral of a (d_x d_x (D R_ab) - 2 d_x (d_x D R_ab)) + <R_xx R_ab>,
// which needs no derivatives higher than the slopes'. In the second, D may be counted from its mean over the footprint,
// which keeps the digits where the footprint is much longer than the waves and D hardly varies: the constant times the
// mean of d_x d_x R_ab is a sum over the spectrum.
FootprintShift FootprintShiftOf(const BeamSpectrum& spectrum, const LagProducts& products, const Eigen::Matrix3d& pairs,
                                const FootprintKernel& footprint);

}  // namespace albtpu
