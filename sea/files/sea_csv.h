// The canonical text of a sea; the limits of all sea files, and text that may be compressed by gzip.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "sea/files/sea_series.h"

namespace albtpu {

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
bool IsSeaCsv(std::string_view first_line);

absl::StatusOr<SeaSeries> ReadSeaCsv(std::string_view text);

// The limits of a file of the sea. A file within them takes less than 2 GB of memory.

inline constexpr std::size_t kMaxSeaBytes = std::size_t{1} << 29;    // inflated; a century of a buoy has 300 MB
inline constexpr std::size_t kMaxSeaRecords = std::size_t{1} << 20;  // a century of hourly records
inline constexpr std::size_t kMaxSeaValues = std::size_t{1} << 25;   // 8 bytes each
inline constexpr std::size_t kMaxFrequencies = 4096;                 // or directions, or wavenumbers

// Numbers outside of these ranges describe no sea. The wire (sea.proto) has the same ranges.
inline constexpr double kLowestFrequency = 1e-4, kHighestFrequency = 100;    // Hz
inline constexpr double kLowestWavenumber = 1e-6, kHighestWavenumber = 1e6;  // rad/m
// Of E [m^2/Hz], of E per rad, and of S [m^3]. Waves of 100 m, all in one bin of 0.0001 Hz, have 6e6 m^2/Hz.
inline constexpr double kMaxDensity = 1e12;
// Rounding, in sums and in decimals, may make a harmonic longer than the energy that it belongs to, by this part of it.
inline constexpr double kHarmonicRounding = 1e-6;
inline constexpr double kDeepestWater = 2e4;   // m
inline constexpr double kStrongestWind = 150;  // m/s

// Text that may be compressed by gzip.

bool IsGzip(std::string_view bytes);

// Inflates one or more gzip streams that follow each other. More than `most` bytes are refused.
absl::StatusOr<std::string> Inflated(std::string_view bytes, std::size_t most = kMaxSeaBytes);

}  // namespace albtpu
