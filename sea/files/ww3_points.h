// Spectra at points as WAVEWATCH III's point output (ww3_outp, type 1, transfer file) writes them:
//
//     'WAVEWATCH III SPECTRA'     50    36     1 'spectral resolution for points'
//      0.350E-01 0.375E-01 ...                  frequencies, Hz
//       0.148E+01  0.131E+01 ...                directions towards which waves travel, compass, rad
//     20220912 060000
//     '44097     '  40.98 -71.12      46.6   1.45 225.6   0.18  94.1
//       0.261E-17  0.551E-18 ...                m^2/Hz/rad, frequency after frequency for each direction
//
// The line of a point has its name, latitude and longitude, depth [m], wind speed at 10 m [m/s] and the direction from
// which the wind comes [degrees], speed and direction of the current, which are left out. Columns of fixed width may
// touch: "40.98-171.12".
//
// Source: the manual of WAVEWATCH III, "Point output post-processor".
#pragma once

#include <string_view>

#include "absl/status/statusor.h"
#include "sea/files/sea_series.h"

namespace albtpu {

bool IsWw3Points(std::string_view first_line);

absl::StatusOr<SeaSeries> ReadWw3Points(std::string_view text);

}  // namespace albtpu
