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
  for (int i = 0; i < 3; ++i) boresight[i] = single(kDegree * errors.boresight[i]);
  lever_arm = single(errors.lever_arm);
  scan = single(kDegree * errors.scan);
  time = single(errors.time);
  range_offset = single(errors.range_offset);
  bottom_range = single(errors.bottom_range);
  surface_range = located == SurfaceLocation::kPulse ? single(errors.surface_range) : 0;
  for (std::size_t group = 0; group < kErrorGroups; ++group) {
    const bool here = static_cast<std::size_t>(SurfaceHeightGroup(located)) == group;
    surface_height[group] = here ? single(errors.surface_height) : 0;
  }
  refractive = single(errors.index);
}

}  // namespace albtpu
