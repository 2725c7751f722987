#include "tables/axis.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "tables/format.h"

namespace albtpu {
namespace {

double Scaled(double coordinate, Scale scale) { return scale == Scale::kLog ? std::log(coordinate) : coordinate; }

// "12 m", "3 m s-1": a coordinate as messages print it. Nine digits distinguish any two floats.
std::string WithUnits(double value, const AxisSchema& schema) {
  return absl::StrFormat("%.9g %s", value, std::string(schema.units));
}

// The rule that the node at `index` breaks; empty if it breaks none.
std::string Problem(const AxisSchema& schema, Scale scale, const std::vector<double>& nodes, std::size_t index) {
  const double node = nodes[index];
  if (!std::isfinite(node)) return absl::StrCat(WithUnits(node, schema), ": nodes must be finite");
  if (static_cast<double>(static_cast<float>(node)) != node) {
    return absl::StrFormat("%.17g %s, not representable in single precision: the nearest node is %.17g", node,
                           std::string(schema.units), static_cast<float>(node));
  }
  if (node < 0) return absl::StrCat(WithUnits(node, schema), ": nodes must not be negative");
  if (node > format::kMaxNode)
    return absl::StrFormat("%s: nodes must not be above %g", WithUnits(node, schema), format::kMaxNode);
  if (scale == Scale::kLog && node < format::kMinNodeDistance) {
    return absl::StrFormat("%s: nodes on a log scale must be positive, %g at least", WithUnits(node, schema),
                           format::kMinNodeDistance);
  }
  if (schema.fold != Fold::kNone && node > MaxAngle(schema.fold)) {
    const double greatest = MaxAngle(schema.fold);
    return absl::StrFormat("%s: nodes must not be above %g degree (larger azimuths are folded into 0 to %g degree)",
                           WithUnits(node, schema), greatest, greatest);
  }
  if (index > 0 && !(node > nodes[index - 1])) {
    return absl::StrFormat("%s, not above node %d (%s): nodes must increase", WithUnits(node, schema), index - 1,
                           WithUnits(nodes[index - 1], schema));
  }
  if (index > 0 && node - nodes[index - 1] < format::kMinNodeDistance) {
    return absl::StrFormat("%s, too close to node %d (%s): nodes must be %g apart", WithUnits(node, schema), index - 1,
                           WithUnits(nodes[index - 1], schema), format::kMinNodeDistance);
  }
  return "";
}

}  // namespace

std::string_view Name(Scale scale) { return scale == Scale::kLog ? "log" : "linear"; }

absl::StatusOr<Axis> Axis::Create(AxisId id, std::vector<double> nodes) {
  return Create(Describe(id), std::move(nodes));
}

absl::StatusOr<Axis> Axis::Create(AxisId id, std::vector<double> nodes, Scale scale) {
  return Create(Describe(id), std::move(nodes), scale);
}

absl::StatusOr<Axis> Axis::Create(const AxisSchema& schema, std::vector<double> nodes) {
  return Create(schema, std::move(nodes), schema.scale);
}

absl::StatusOr<Axis> Axis::Create(const AxisSchema& schema, std::vector<double> nodes, Scale scale) {
  const std::string name(schema.name);
  if (nodes.empty())
    return absl::InvalidArgumentError(absl::StrFormat("axis '%s' has no nodes: it needs at least one", name));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::string problem = Problem(schema, scale, nodes, i);
    if (!problem.empty())
      return absl::InvalidArgumentError(absl::StrFormat("axis '%s' node %d is %s", name, i, problem));
  }
  return Axis(schema, std::move(nodes), scale);
}

Axis::Axis(const AxisSchema& schema, std::vector<double> nodes, Scale scale)
    : schema_(schema), scale_(scale), nodes_(std::move(nodes)) {
  scaled_nodes_.reserve(nodes_.size());
  for (double node : nodes_) scaled_nodes_.push_back(Scaled(node, scale_));
}

AxisId Axis::id() const {
  const std::optional<AxisId> id = FindAxis(schema_.name);
  assert(id.has_value());
  return *id;
}

std::optional<Bracket> Axis::Locate(double coordinate) const {
  if (schema_.fold != Fold::kNone) coordinate = FoldAzimuth(coordinate, schema_.fold);
  if (schema_.is_endless) {
    if (size() == 1 && (coordinate > 0 || (coordinate == 0 && scale_ == Scale::kLinear))) return Bracket{};
    coordinate = std::min(coordinate, nodes_.back());
  }
  // Written so that NaN fails it.
  if (!(coordinate >= nodes_.front() && coordinate <= nodes_.back())) return std::nullopt;
  if (size() == 1) return Bracket{};

  const auto above = std::upper_bound(nodes_.begin(), nodes_.end(), coordinate);
  if (above == nodes_.end()) return Bracket{size() - 2, 1.0};
  const auto lower = static_cast<std::size_t>(std::distance(nodes_.begin(), above)) - 1;
  const double from = scaled_nodes_[lower], to = scaled_nodes_[lower + 1];
  return Bracket{lower, (Scaled(coordinate, scale_) - from) / (to - from)};
}

std::span<const double> Axis::alternatives() const {
  if (schema_.if_absent == IfAbsent::kLargerOfEnds) return kFoldedEnds;
  if (schema_.if_absent == IfAbsent::kLargestOfNodes) return nodes_;
  return {};
}

double FoldAzimuth(double azimuth, Fold fold) {
  assert(fold != Fold::kNone);
  const double rest = std::fmod(std::abs(azimuth), 180.0);
  if (fold == Fold::kQuadrant) return std::min(rest, 180.0 - rest);
  return azimuth < 0 && rest > 0 ? static_cast<float>(180.0 - rest) : rest;
}

}  // namespace albtpu
