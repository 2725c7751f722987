// Locates many coordinates on an axis at a time: the fast twin of `Axis::Locate`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tables/axis.h"

namespace albtpu {

// The outcome of a pulse on an axis as a number: the index of the axis if the coordinate is invalid, kOutside plus
// that index if it is outside the nodes, or kInside. The outcome of the pulse is the minimum over all axes.
namespace outcome_code {
inline constexpr std::int32_t kOutside = 8;
inline constexpr std::int32_t kInside = 16;
static_assert(kMaxAxes <= kOutside);
}  // namespace outcome_code

// Immutable.
class AxisLookup {
 public:
  // `index` is the place of the axis in its table.
  AxisLookup(const Axis& axis, std::size_t index);

  Fold fold() const { return nodes_.fold; }
  float last_node() const { return nodes_.nodes.back(); }

  // Counts of coordinates are multiples of this.
  static constexpr std::size_t kPadding = 8;

  // The largest magnitude of an azimuth in degrees. Azimuths beyond it have to be folded first.
  static constexpr float kFarthestAzimuth = 1e6f;

  // For each of `count` coordinates, in the units of the axis: adds `step` times the index of the node below it to
  // `rows`, sets `fractions` to the fraction of the distance to the next node, 0 to 1 and exactly 0 or 1 on a node,
  // and lowers `codes` to the outcome on this axis. A coordinate that is not inside counts as the first node.
  // Outcomes and nodes are exactly those of `Axis::Locate`; fractions differ from its fractions by 1e-6 at most.
  void Locate(const float* coordinates, std::size_t count, std::int32_t step, std::int32_t* rows, float* fractions,
              std::int32_t* codes) const;

  // Adds `step` times the index of the node below each of `count` coordinates to `rows`. For a coordinate that is not
  // inside, or an azimuth beyond kFarthestAzimuth, it is any node but the last, or the only one.
  void AddLowerNodes(const float* coordinates, std::size_t count, std::int32_t step, std::int32_t* rows) const;

  // The data that the kernels read.
  struct Nodes {
    std::vector<float> nodes;
    // 1 / the distance of two neighbours; on a log scale, the distance of their logarithms.
    std::vector<float> inverse_widths;
    std::int32_t axis;  // its index in the table
    bool log;
    Fold fold;     // AxisSchema::fold
    bool endless;  // AxisSchema::is_endless
  };

 private:
  Nodes nodes_;
};

}  // namespace albtpu
