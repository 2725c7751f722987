#include "formats/text/percent_text.h"

#include <cmath>

#include "absl/strings/str_format.h"

namespace albtpu::formats {

std::string PercentText(double fraction) {
  const double percent = 100 * fraction;
  return std::abs(percent) < 10 ? absl::StrFormat("%.2g %%", percent) : absl::StrFormat("%.0f %%", percent);
}

}  // namespace albtpu::formats
