#include "quality/report/surface_nodes.h"

#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"

namespace albtpu::quality {
namespace {

using Json = nlohmann::ordered_json;

Json SurfaceMember(const Json& json, const char* key) { return json.is_object() ? json.value(key, Json()) : Json(); }

}  // namespace

absl::Status CheckSurface(const Json& surface, std::uint64_t points_with_number) {
  if (surface.is_null()) return absl::OkStatus();
  const Json points = SurfaceMember(surface, "points_with_number");
  if (!SurfaceMember(surface, "nodes").is_number_unsigned() || !SurfaceMember(surface, "order_met").is_object())
    return absl::InvalidArgumentError("--surface: its surface.json is none of albtpu-query surface; make it again");
  if (points == points_with_number) return absl::OkStatus();
  return absl::FailedPreconditionError(absl::StrCat("--surface: is of ", points.dump(),
                                                    " points with a number, where these files have ",
                                                    points_with_number, "; give the surface that was made of them"));
}

Json NodesOf(const Json& surface, const std::string& order, double pass_share) {
  if (surface.is_null()) return nullptr;
  // Each node of the bottom counts for the strictest order that it meets, or for "none", and these begin with the
  // strictest. Nodes of land alone have no order.
  std::uint64_t nodes = 0, meeting = 0;
  bool strict_enough = true;
  const Json orders = SurfaceMember(surface, "order_met");
  for (const auto& [name, count] : orders.items()) {
    const std::uint64_t of_order = count.is_number_unsigned() ? count.get<std::uint64_t>() : 0;
    nodes += of_order;
    if (strict_enough) meeting += of_order;
    if (name == order) strict_enough = false;
  }
  const double fraction = nodes > 0 ? static_cast<double>(meeting) / static_cast<double>(nodes) : 0;
  return {{"cell", SurfaceMember(surface, "cell")},
          {"nodes", nodes},
          {"meeting", meeting},
          {"fraction", fraction},
          {"passes", 100 * fraction >= pass_share}};
}

}  // namespace albtpu::quality
