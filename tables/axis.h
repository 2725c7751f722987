// One axis of a table: the nodes at which values are known, and where a coordinate lies between them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "tables/schema.h"
#include "tables/table_schema.h"

namespace albtpu {

// A coordinate between the nodes `lower` and `lower + 1`, as a fraction in [0, 1] of the distance between them in the
// scale of the axis. On an axis of one node, `lower` is 0 and `fraction` is 0.
struct Bracket {
  std::size_t lower = 0;
  double fraction = 0;
};

// Immutable. Nodes are representable in float32, finite and increasing, and belong to the domain at both ends.
class Axis {
 public:
  // Fails with InvalidArgument, naming the axis and the node, if there is no node, or if a node is not finite, is not
  // representable in float32, is negative, does not increase, breaks the limits of format.h, which on a log scale are
  // above 0, or is above the largest angle of a folded axis. Without a scale, the axis has that of its schema. The
  // axis copies `schema`, but not its texts (name, units, long_name): they must outlive the axis.
  static absl::StatusOr<Axis> Create(const AxisSchema& schema, std::vector<double> nodes);
  static absl::StatusOr<Axis> Create(const AxisSchema& schema, std::vector<double> nodes, Scale scale);
  // An axis of the sea surface.
  static absl::StatusOr<Axis> Create(AxisId id, std::vector<double> nodes);
  static absl::StatusOr<Axis> Create(AxisId id, std::vector<double> nodes, Scale scale);

  const AxisSchema& schema() const { return schema_; }
  AxisId id() const;  // Requires an axis of the sea surface.
  Scale scale() const { return scale_; }
  const std::vector<double>& nodes() const { return nodes_; }
  std::size_t size() const { return nodes_.size(); }

  // The place of `coordinate`, in the units of the axis; nullopt if it is outside the nodes or not a number. A folded
  // axis folds it first. An endless axis holds it at the last node; if it has one node only, it answers as
  // AxisSchema::is_endless says.
  std::optional<Bracket> Locate(double coordinate) const;

  // The coordinates of the answers of which a query without coordinate takes the largest values; none if it takes no
  // largest (IfAbsent).
  std::span<const double> alternatives() const;

 private:
  Axis(const AxisSchema& schema, std::vector<double> nodes, Scale scale);

  AxisSchema schema_;
  Scale scale_;
  std::vector<double> nodes_;
  std::vector<double> scaled_nodes_;  // The nodes, or their logarithms.
};

// The angle that has the same statistics as `azimuth`, which may be any finite angle in degrees: in [0, 90] degrees
// (kQuadrant) or [0, 180] (kHalfTurn). A Gaussian sea looks the same after a turn by 180 degrees, and a wind sea when
// mirrored at the wind axis. Where half a turn is added to a negative angle, the sum is rounded to single precision,
// which coordinates and nodes have.
double FoldAzimuth(double azimuth, Fold fold = Fold::kQuadrant);

// The largest angle after folding. Requires `fold` other than kNone.
constexpr double MaxAngle(Fold fold) { return fold == Fold::kQuadrant ? 90 : 180; }

// The two azimuths [degree] of IfAbsent::kLargerOfEnds.
inline constexpr double kFoldedEnds[] = {0, 90};

}  // namespace albtpu
