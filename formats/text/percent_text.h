// Fractions as text in per cent.
#pragma once

#include <string>

namespace albtpu::formats {

// "0.28 %", "18 %": two significant digits, and all digits before the point.
std::string PercentText(double fraction);

}  // namespace albtpu::formats
