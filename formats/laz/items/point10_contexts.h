// Classes of similar points of formats 0 to 5, by their return number r of n returns: the contexts in which LASzip
// predicts intensities and coordinates, for all numbers of three bits, plausible or not.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace albtpu::laz {

struct Point10Context {
  std::uint8_t
      returns;  // Of 16: the possible pairs (r, n) up to n = 5 in their order, further ones among them.
  std::uint8_t level;  // |n - r|: how many returns lie below.
  bool single;         // n = 1.
};

inline constexpr std::size_t kReturnContexts = 16, kLevels = 8;

// By the low six bits of the byte that has r in bits 0 to 2 and n in bits 3 to 5.
inline constexpr std::array<Point10Context, 64> kPoint10Contexts = [] {
  constexpr std::array<std::array<std::uint8_t, 8>, 8> kReturns = {{{15, 14, 13, 12, 11, 10, 9, 8},
                                                                    {14, 0, 1, 3, 6, 10, 10, 9},
                                                                    {13, 1, 2, 4, 7, 11, 11, 10},
                                                                    {12, 3, 4, 5, 8, 12, 12, 11},
                                                                    {11, 6, 7, 8, 9, 13, 13, 12},
                                                                    {10, 10, 11, 12, 13, 14, 14, 13},
                                                                    {9, 10, 11, 12, 13, 14, 15, 14},
                                                                    {8, 9, 10, 11, 12, 13, 14, 15}}};
  std::array<Point10Context, 64> contexts{};
  for (std::size_t n = 0; n < 8; ++n) {
    for (std::size_t r = 0; r < 8; ++r) {
      contexts[n << 3 | r] = {kReturns[n][r], static_cast<std::uint8_t>(n > r ? n - r : r - n), n == 1};
    }
  }
  return contexts;
}();

}  // namespace albtpu::laz
