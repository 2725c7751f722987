// The foot, in which maps and heights may be.
#pragma once

namespace albtpu::formats {

inline constexpr double kMetresOfFoot = 0.3048;  // exact; the US survey foot differs by 2e-6 of it.

}  // namespace albtpu::formats
