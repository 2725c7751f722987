// The canonical text of a sea: comma-separated, one line for each frequency or wavenumber.
//
//     f,E,r2,alpha2                      k,S,a2,b2,a4,b4
//     0.05,0.12,0.41,230                 0.004,0,0,0,0,0
//     0.06,0.31,,                        0.0042,1.3e-7,0.31,-0.02,0.1,0
//
// Over frequency: f [Hz], E [m^2/Hz], r2 from 0 to 1 and alpha2 [degrees of the compass], the last two absent or empty
// where the waves are isotropic. A first column `time` (UTC: 2020-06-08T03:50Z) makes a series.
//
// Over wavenumber: k [rad/m], S [m^3] and as many harmonics as the sea has, means of cos(2 psi), sin(2 psi), cos(4 psi)
// and so on, with psi counter-clockwise from the downwind direction, or from north if the wind direction is not known.
// Such a sea is complete: no tail is joined.
//
// Lines that begin with # are comments.
#pragma once

#include <string_view>

#include "absl/status/statusor.h"
#include "sea/files/sea_series.h"

namespace albtpu {

bool IsSeaCsv(std::string_view first_line);

absl::StatusOr<SeaSeries> ReadSeaCsv(std::string_view text);

}  // namespace albtpu
