// The verdict by the nodes of a surface, beside that by points.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "quality/annotated/annotated_points.h"

namespace albtpu::quality {

// Whether `part` of `whole` are `percent` of it or more, also where a percentage is no binary fraction.
inline bool Reach(std::uint64_t part, std::uint64_t whole, double percent) {
  constexpr double kRounding = 1e-12;
  return 100 * static_cast<double>(part) >= percent * static_cast<double>(whole) * (1 - kRounding);
}

// `surface` is surface.json of `albtpu-query surface`, or null. FailedPrecondition where it is of other files, or of
// other annotations of them.
absl::Status CheckSurface(const nlohmann::ordered_json& surface, const std::vector<AnnotatedLasFile>& files);

// How many nodes of the bottom meet an order of S-44, by their uncertainty and bias and the THU of their points; null
// without a surface. Nodes of land alone do not count. `pass_share`: %.
nlohmann::ordered_json NodesOf(const nlohmann::ordered_json& surface, const std::string& order, double pass_share);

}  // namespace albtpu::quality
