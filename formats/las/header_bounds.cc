#include "formats/las/header_bounds.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_format.h"

namespace albtpu::formats {
namespace {

constexpr double kRoundedBounds = 1;  // m; programs round the bounds of a header.

}  // namespace

std::string WrongBounds(const LasHeader& header, const LasBounds& box, const std::array<double, 3>& metres) {
  std::string wrong;
  for (std::size_t axis = 0; axis < metres.size() && header.point_count > 0; ++axis) {
    const auto is_off = [&](double stated, double found) {
      return !(std::abs(stated - found) * metres[axis] <= kRoundedBounds);
    };
    if (!is_off(header.least[axis], box.least[axis]) && !is_off(header.greatest[axis], box.greatest[axis])) continue;
    absl::StrAppendFormat(&wrong, "%s%c %.10g to %.10g instead of %.10g to %.10g", wrong.empty() ? "" : ", ",
                          "xyz"[axis], header.least[axis], header.greatest[axis], box.least[axis], box.greatest[axis]);
  }
  return wrong;
}

std::string ContradictedAxis(const LasHeader& header, const LasBounds& box, const std::array<double, 3>& metres) {
  for (std::size_t axis = 0; axis < metres.size() && header.point_count > 0; ++axis) {
    const double least = header.least[axis] - header.offset[axis], found_least = box.least[axis] - header.offset[axis];
    const double greatest = header.greatest[axis] - header.offset[axis];
    const double found_greatest = box.greatest[axis] - header.offset[axis];
    const double step = 4 * std::abs(header.scale[axis]);
    if (!(std::abs(least - found_least) * metres[axis] > kRoundedBounds)) continue;
    if (!(std::abs(greatest - found_greatest) * metres[axis] > kRoundedBounds)) continue;
    const bool shifted = std::abs((least - found_least) - (greatest - found_greatest)) <= step;
    // With a negative factor, the greatest is that of the least; a factor of 1 would exchange the two alone.
    const auto scaled = [&](double first, double second) {
      const double factor = first / found_least;
      return factor != 0 && std::abs(factor - 1) > 1e-9 &&
             std::abs(factor * found_greatest - second) <= step * std::max(1.0, std::abs(factor));
    };
    if (shifted || scaled(least, greatest) || scaled(greatest, least)) return std::string(1, "xyz"[axis]);
  }
  return "";
}

}  // namespace albtpu::formats
