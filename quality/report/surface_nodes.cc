#include "quality/report/surface_nodes.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "absl/strings/str_cat.h"

namespace albtpu::quality {
namespace {

using Json = nlohmann::ordered_json;

Json SurfaceMember(const Json& json, const char* key) { return json.is_object() ? json.value(key, Json()) : Json(); }

}  // namespace

absl::Status CheckSurface(const Json& surface, const std::vector<AnnotatedLasFile>& files) {
  if (surface.is_null()) return absl::OkStatus();
  const Json annotations = SurfaceMember(surface, "annotations_digest");
  if (!SurfaceMember(surface, "nodes").is_number_unsigned() || !SurfaceMember(surface, "order_met").is_object() ||
      !annotations.is_string())
    return absl::InvalidArgumentError("--surface: its surface.json is none of albtpu-query surface; make it again");
  std::vector<std::string> digests;
  for (const AnnotatedLasFile& file : files) digests.push_back(file.summary_digest());
  if (annotations == DigestOfAnnotations(std::move(digests))) return absl::OkStatus();
  return absl::FailedPreconditionError(absl::StrCat(
      "--surface: is of other files or annotations (", SurfaceMember(surface, "files").dump(), " files with ",
      SurfaceMember(surface, "points_with_number").dump(), " points that have a number) than these ", files.size(),
      " files; give the surface that was made of them"));
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
          {"passes", nodes > 0 && Reach(meeting, nodes, pass_share)}};
}

}  // namespace albtpu::quality
