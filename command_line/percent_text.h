// Fractions as people read them.
#pragma once

#include <string>

namespace albtpu {

// "0.28 %", "18 %": two significant digits, and all digits before the point.
std::string PercentText(double fraction);

}  // namespace albtpu
