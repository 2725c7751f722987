// What a file of the sea may hold at most. A file within these limits takes less than 2 GB of memory.
#pragma once

#include <cstddef>

namespace albtpu {

inline constexpr std::size_t kMostSeaBytes = std::size_t{1}
                                             << 29;  // inflated; a century of a buoy has 300 MB
inline constexpr std::size_t kMostSeaRecords = std::size_t{1} << 20;  // a century of hourly records
inline constexpr std::size_t kMostSeaValues = std::size_t{1} << 25;   // 8 bytes each
inline constexpr std::size_t kMostFrequencies = 4096;                 // or directions, or wavenumbers

// What else can be no sea.
inline constexpr double kLowestFrequency = 1e-4, kHighestFrequency = 100;  // Hz
inline constexpr double kShortestPeak = 0.5, kLongestPeak = 99;  // s, of waves with a height and a period
inline constexpr double kDeepestWater = 2e4;                     // m
inline constexpr double kStrongestWind = 150;                    // m/s

}  // namespace albtpu
