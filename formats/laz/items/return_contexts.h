// The kinds of returns by which the layers of formats 6 to 10 choose contexts: a return is predicted from earlier ones
// of its kind.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>

namespace albtpu::laz {

// Both are from 0 to 15 and need not be plausible: files have return 0, or more returns than there are.
struct Returns {
  std::uint8_t number = 0;  // Of this return in its pulse.
  std::uint8_t count = 0;   // Of all returns of the pulse.

  static Returns From(std::uint8_t byte) {
    return {static_cast<std::uint8_t>(byte & 15), static_cast<std::uint8_t>(byte >> 4)};
  }
  std::uint8_t byte() const { return static_cast<std::uint8_t>(count << 4 | number); }

  // 1: the first of its pulse; 2: the last; 3: the only one; 0: between.
  std::uint32_t place() const { return (number == 1 ? 1u : 0u) | (number >= count ? 2u : 0u); }
  std::uint32_t is_alone() const { return count == 1 ? 1u : 0u; }
};

inline constexpr int kReturnKinds = 6;
inline constexpr int kReturnLevels = 8;

// The kind of a return, which correlates with the distance of the previous point: [count][number], prescribed by the
// format.
inline constexpr std::array<std::array<std::uint8_t, 16>, 16> kReturnKind = {{
    {0, 1, 2, 3, 4, 5, 3, 4, 4, 5, 5, 5, 5, 5, 5, 5},
    {1, 0, 1, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3},
    {2, 1, 2, 4, 4, 4, 4, 4, 4, 4, 4, 3, 3, 3, 3, 3},
    {3, 3, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
    {4, 3, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
    {5, 3, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
    {3, 3, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4},
    {4, 3, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4},
    {4, 3, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4},
    {5, 3, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4},
    {5, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4},
    {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 4, 4, 4},
    {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4, 4},
    {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4},
    {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5},
    {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5},
}};

inline std::uint32_t ReturnKind(Returns returns) { return kReturnKind[returns.count][returns.number]; }

// How many returns of the pulse follow, at most 7: returns of a level have similar heights.
inline std::uint32_t ReturnLevel(Returns returns) {
  const int level = std::abs(int{returns.count} - int{returns.number});
  return static_cast<std::uint32_t>(level < kReturnLevels ? level : kReturnLevels - 1);
}

}  // namespace albtpu::laz
