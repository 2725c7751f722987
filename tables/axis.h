// One axis of a table: the nodes at which values are known, and where a coordinate lies between them.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "tables/schema.h"

namespace albtpu {

// A coordinate between the nodes `lower` and `lower + 1`, as a fraction in [0, 1] of the way in the axis'
// scale. On an axis of one node, `lower` is 0 and `fraction` is 0.
struct Bracket {
  std::size_t lower = 0;
  double fraction = 0;
};

// Immutable. Nodes are representable in float32, finite and increasing, and are part of the domain at both
// ends.
class Axis {
 public:
  // Fails with InvalidArgument, naming the axis and the node, when there is no node, when a node is not
  // finite, is not representable in float32, is negative, does not increase, or is not positive on a log
  // scale; when it breaks the limits of format.h; or when an azimuth is above 90 degrees.
  static absl::StatusOr<Axis> Create(AxisId id, std::vector<double> nodes);
  static absl::StatusOr<Axis> Create(AxisId id, std::vector<double> nodes, Scale scale);

  AxisId id() const { return id_; }
  Scale scale() const { return scale_; }
  const std::vector<double>& nodes() const { return nodes_; }
  std::size_t size() const { return nodes_.size(); }

  // Where `coordinate` lies, in the units of the axis; nothing when it is outside the nodes (or not a
  // number). Azimuth is folded into 0-90 degrees first; fetch above its last node is held at it, and an axis
  // of one fetch answers at any fetch above zero.
  std::optional<Bracket> Locate(double coordinate) const;

 private:
  Axis(AxisId id, std::vector<double> nodes, Scale scale);

  AxisId id_;
  Scale scale_;
  std::vector<double> nodes_;
  std::vector<double> scaled_nodes_;  // The nodes, or their logarithms.
};

// The azimuth in [0, 90] degrees that has the same statistics as `azimuth`, which may be any finite angle in
// degrees: a Gaussian sea looks the same after a turn by 180 degrees and in the mirror of the wind axis.
double FoldAzimuth(double azimuth);

}  // namespace albtpu
