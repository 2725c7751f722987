// The limits of a file of the sea. A file within them takes less than 2 GB of memory.
#pragma once

#include <cstddef>

namespace albtpu {

inline constexpr std::size_t kMaxSeaBytes = std::size_t{1} << 29;  // inflated; a century of a buoy has 300 MB
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
inline constexpr double kShortestPeak = 0.5, kLongestPeak = 99;  // s, of waves with a height and a period
inline constexpr double kDeepestWater = 2e4;                     // m
inline constexpr double kStrongestWind = 150;                    // m/s

}  // namespace albtpu
