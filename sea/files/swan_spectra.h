// Spectra as SWAN writes them (command SPECOUT SPEC2D ASCII) and reads them at its boundaries:
//
//     SWAN   1                 Swan standard spectral file, version
//     TIME                     or not, where the sea is stationary
//          1                   time coding option: ISO notation
//     LONLAT                   or LOCATIONS, in m
//          1                   number of locations
//       174.672501  -38.173599
//     AFREQ                    or RFREQ: absolute or relative frequencies, the same without current
//         24
//         0.04000 ...
//     NDIR                     nautical: clockwise from north, or CDIR: counter-clockwise from the east
//         36
//          5.0000 ...
//     QUANT
//          1
//     VaDens                   m2/Hz/degr, or EnDens: J/m2/Hz/degr
//     m2/Hz/degr
//        -99                   exception value
//     20161011.000000          date and time
//     FACTOR                   or ZERO (no waves), or NODATA (a dry point)
//         1.68566278E-05
//         0    0    3 ...      a line for each frequency, times the factor
//
// Words behind the first on a line, and lines that begin with $, are comments.
//
// Source: SWAN User Manual, Appendix D, "Spectrum files, input and output".
#pragma once

#include <string_view>

#include "absl/status/statusor.h"
#include "sea/files/sea_series.h"

namespace albtpu {

bool IsSwanSpectra(std::string_view first_line);

absl::StatusOr<SeaSeries> ReadSwanSpectra(std::string_view text);

}  // namespace albtpu
