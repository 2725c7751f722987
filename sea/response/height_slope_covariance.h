// The covariance of height and slope within a footprint, which displaces a beam at the depth 0, from the spectrum.
#pragma once

#include <Eigen/Core>

#include "sea/response/beam_spectrum.h"
#include "sea/response/footprint_kernel.h"
#include "sea/response/lag_covariances.h"

namespace albtpu {

// With <> the mean over the footprint, q = <h m> - <h> <m>, a vector along and across the azimuth. Returns E[q q^T],
// m^2.
//
// Derivation: Wick's theorem gives E[q_a q_b] as three means over the footprint ("Height and slope within the
// footprint" in docs/physics.md). With C the covariance of heights, that of height and slope is its gradient, and that
// of slopes less its second derivatives, so that C R_ab - G_a G_b = -1/2 d_a d_b C^2. With D = C(0) - C in place of C,
// which changes nothing, the autocorrelation a and the irradiance w of the footprint, D' = w * D and D" the mean of D
// over a,
//     E[q_a q_b] = -1/2 integral of a d_a d_b D^2 + integral of w d_a d_b D'^2 - D" V_ab.
Eigen::Matrix2d HeightSlopeCovariance(const BeamSpectrum& spectrum, const LagProducts& products,
                                      const FootprintKernel& footprint);

}  // namespace albtpu
