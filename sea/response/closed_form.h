// The small-slope theory: the uncertainty of a beam in the limit of small slopes, from the spectrum alone. The
// section "The limit of small slopes" of docs/physics.md derives it.
//
// For a footprint much smaller than the depth the spot moves with the footprint-averaged slope: the tangent of the
// mean refracted direction is linear in that slope, with the gains of refraction.h. The theory is the oracle of the
// Monte Carlo, which agrees with it as the slopes vanish and lies below it for steeper seas, because Snell's law is
// not linear in slope: THU is lower by 0.18 of the mean square slope of the whole sea at nadir (0.189 by the third
// order in slope) and by another 0.07 of it at 20 degrees, growing with the square of the incidence.
#pragma once

#include "sea/response/footprint.h"
#include "sea/sea_state.h"

namespace albtpu {

// 2 sigma values: angles in rad, the others in m per m of depth.
struct SmallSlopeUncertainty {
  double refraction_along_wind, refraction_cross_wind;
  double thu_per_depth;
  double tvu_per_depth;  // zero at nadir, where the vertical error is of second order in slope
};

SmallSlopeUncertainty ClosedForm(const SeaState& sea, const BeamOptions& beam, double refractive_index);

}  // namespace albtpu
