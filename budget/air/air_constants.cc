#include "budget/air/air_constants.h"

#include <numbers>

namespace albtpu {

AirConstants::AirConstants(const AirErrors& errors, SurfaceLocation located, double n,
                           const std::array<double, 3>& lever) {
  constexpr double kDegree = std::numbers::pi / 180;
  const auto single = [](double value) { return static_cast<float>(value); };
  inverse_index = single(1 / n);
  inverse_square_index = single(1 / (n * n));
  given = located == SurfaceLocation::kLevel ? 1 : 0;
  scan_given = located == SurfaceLocation::kPulse ? 0 : 1;
  forward = single(lever[0]);
  right = single(lever[1]);
  down = single(lever[2]);
  auto sigma = sigmas.begin();
  for (const ErrorSource& source : kErrorSources) {
    const double scale = source.unit == "degree" ? kDegree : 1;
    for (const double number : source.In(errors)) *sigma++ = single(scale * number);
  }
  if (located != SurfaceLocation::kPulse) sigmas[FirstNumber(&AirErrors::surface_range)] = 0;
  for (std::size_t group = 0; group < kErrorGroups; ++group) {
    const bool here = static_cast<std::size_t>(located) == group;
    surface_height[group] = here ? single(errors.surface_height) : 0;
  }
}

}  // namespace albtpu
