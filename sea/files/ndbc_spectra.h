// Spectra of NDBC buoys: energy, r2 and alpha2 by frequency.
#pragma once

#include <optional>
#include <string_view>

#include "absl/status/statusor.h"
#include "sea/files/sea_series.h"

namespace albtpu {

// The frequency [Hz] up to which the waves of NDBC's buoys are trusted. Its wave analyzers report up to 0.4 Hz; later
// systems add bands up to 0.485 Hz (https://www.ndbc.noaa.gov/faq/wavespectra.shtml), whose waves, 6.6 m long, a hull
// of 3 m hardly follows.
inline constexpr double kNdbcTrustedUpTo = 0.4;

// The time [s] over which NDBC measures the waves of an hour: 20 minutes,
// https://www.ndbc.noaa.gov/faq/measdes.shtml.
inline constexpr double kNdbcRecordLength = 1200;

// The texts of the files. Without the last two, the waves are isotropic, and SeaSeries::assumed says so.
struct NdbcTexts {
  std::string_view energy;                                                            // .data_spec, or w
  std::optional<std::string_view> spread = {};                                        // r2: .swr2, or k
  std::optional<std::string_view> direction = {};                                     // alpha2: .swdir2, or i
  std::string spread_name = "the file of r2", direction_name = "the file of alpha2";  // for messages
};

// D = (1 + 2 r2 cos 2 (c - alpha2)) / (2 pi): where r2 or alpha2 is missing, a bin is isotropic. Bins without energy
// are left out; so are records with fewer than two bins.
absl::StatusOr<SeaSeries> ReadNdbcSpectra(const NdbcTexts& texts);

}  // namespace albtpu
