// The fields of a point record of formats 6 to 10: 30 bytes. Source: LAS 1.4 R15, table 14.
#pragma once

#include <cstddef>
#include <cstdint>

namespace albtpu::laz {

inline constexpr std::size_t kPoint14Size = 30;

inline constexpr std::size_t kXOffset = 0, kYOffset = 4, kZOffset = 8;  // i32.
inline constexpr std::size_t kIntensityOffset = 12;                     // u16.
inline constexpr std::size_t kReturnsOffset = 14;                       // Returns::From().
inline constexpr std::size_t kFlagsOffset = 15;                         // PointFlags() and ScannerChannel().
inline constexpr std::size_t kClassOffset = 16, kUserDataOffset = 17;   // u8.
inline constexpr std::size_t kAngleOffset = 18;                         // i16.
inline constexpr std::size_t kSourceOffset = 20;                        // u16.
inline constexpr std::size_t kTimeOffset = 22;                          // f64, of which only the bits are coded.

// Bits 0 to 3 are the classification flags, 4 and 5 the scanner channel, 6 the direction of the scan, 7 the edge of the
// flight line.
inline std::uint32_t ScannerChannel(std::uint8_t byte) { return byte >> 4 & 3u; }
inline std::uint32_t PointFlags(std::uint8_t byte) { return (byte & 15u) | (byte >> 2 & 0x30u); }
inline std::uint8_t FlagsByte(std::uint32_t flags, std::uint32_t channel) {
  return static_cast<std::uint8_t>((flags & 15) | channel << 4 | (flags & 0x30) << 2);
}

}  // namespace albtpu::laz
