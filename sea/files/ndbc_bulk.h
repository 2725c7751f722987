// Heights, periods and directions of NDBC stations: summaries of spectra (.spec), which separate swell from wind waves,
// and standard meteorological data (stdmet), which have the wind.
//
//     #YY  MM DD hh mm WVHT  SwH  SwP  WWH  WWP SwD WWD  STEEPNESS  APD MWD
//     #yr  mo dy hr mn    m    m  sec    m  sec  -  degT     -      sec degT
//     2020 06 08 03 40  1.1  1.0  5.6  0.5  3.6 SSW  SE      STEEP  4.9 196
//
//     #YY  MM DD hh mm WDIR WSPD GST  WVHT   DPD   APD MWD   PRES  ATMP  WTMP  DEWP  VIS PTDY  TIDE
//     2026 07 31 11 40  10  4.0  4.0   1.2     7   6.6 191 1021.2    MM  16.8    MM   MM   MM    MM
//
// Columns are found by their names. Missing values are MM in real time, and in the history nines: 99.00 of heights,
// periods and wind speeds, 999 of directions. Directions are those from which waves and wind come, in degrees or points
// of the compass.
#pragma once

#include <string_view>

#include "absl/status/statusor.h"
#include "sea/files/sea_series.h"

namespace albtpu {

// Files in which no record has waves, as those of stations on the coast (C-MAN) and continuous winds, give the wind
// alone.
bool IsNdbcBulk(std::string_view first_line);

// `anemometer_height` [m, 1 to 100] is that of stdmet's winds, which are converted to 10 m by WindSpeedAt10m().
absl::StatusOr<SeaSeries> ReadNdbcBulk(std::string_view text, double anemometer_height = 10);

}  // namespace albtpu
