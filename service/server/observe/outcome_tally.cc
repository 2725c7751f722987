#include "service/server/observe/outcome_tally.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "albtpu/v1/uncertainty.pb.h"

namespace albtpu::server {

std::size_t OutcomeTally::pulses() const {
  const std::size_t out = std::accumulate(out_of_domain.begin(), out_of_domain.end(), std::size_t{0});
  return std::accumulate(invalid.begin(), invalid.end(), interpolated + out + invalid_aircraft);
}

void OutcomeTally::Add(std::span<const std::uint8_t> outcomes, std::span<const std::uint8_t> outcome_axes) {
  assert(outcomes.size() == outcome_axes.size());
  const auto count = static_cast<std::size_t>(
      std::count(outcomes.begin(), outcomes.end(), static_cast<std::uint8_t>(v1::OUTCOME_INTERPOLATED)));
  interpolated += count;
  if (count == outcomes.size()) return;  // The usual case.
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (outcomes[i] == v1::OUTCOME_INTERPOLATED) continue;
    if (outcome_axes[i] == v1::AXIS_UNSPECIFIED) {
      ++invalid_aircraft;
      continue;
    }
    auto& by_axis = outcomes[i] == v1::OUTCOME_OUT_OF_DOMAIN ? out_of_domain : invalid;
    ++by_axis[outcome_axes[i] - static_cast<std::size_t>(v1::AXIS_WIND_SPEED)];
  }
}

}  // namespace albtpu::server
