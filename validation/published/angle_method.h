// The angle method: from the 2 sigma of a refraction angle to THU and TVU.
//
// It is how tables of published angles become uncertainties of position. The tables that we make do without
// it: they take the errors of position from the traced beams themselves.
#pragma once

#include "generator/math/random_stream.h"

namespace albtpu {

// 2 sigma, m per m of depth.
struct AngleMethodUncertainty {
  double thu_per_depth, tvu_per_depth;
};

// Birkebak et al. (2018), Eq. 24-26 at a depth of 1 m: 2 std(tan(theta + delta)) and 2 std(cos(theta) /
// cos(theta + delta)), delta normal with twice the standard deviation `two_sigma_angle` [rad]. theta is
// `refracted`, the angle of the ray in still water, where the paper says only "incidence": with it, and not
// with the incidence in air, Table 5 comes out.
//
// A normal delta reaches the horizontal, where tangent and secant have no variance, with next to no
// probability (1e-150 in Table 5). It is cut at eight standard deviations, beyond which 1e-15 of it lies; the
// ray must go down there still: refracted + 4 two_sigma_angle < pi/2. The moments are trapezoids in delta,
// which are exact to rounding for a smooth function under a normal density.
AngleMethodUncertainty AngleMethod(double refracted, double two_sigma_angle);

// The same as the paper computes it: the sample's standard deviations over `draws`, at least 2, of delta.
// Both have a standard error of about 1 / sqrt(2 draws) of themselves.
AngleMethodUncertainty AngleMethodByDraws(double refracted, double two_sigma_angle, int draws,
                                          NormalStream stream);

}  // namespace albtpu
