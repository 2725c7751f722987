// Where many coordinates lie on an axis at a time: the fast twin of `Axis::Locate`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tables/axis.h"

namespace albtpu {

// What became of a pulse, as a number of which the least of all axes counts: an axis on which it is invalid,
// kOutside and an axis that does not reach it, or kInside.
namespace outcome_code {
inline constexpr std::int32_t kOutside = 8;
inline constexpr std::int32_t kInside = 16;
}  // namespace outcome_code

// Immutable.
class AxisLookup {
 public:
  explicit AxisLookup(const Axis& axis);

  // Counts of coordinates are multiples of this.
  static constexpr std::size_t kPadding = 8;

  // Azimuths may not be farther from 0 than this, in degrees: fold them first.
  static constexpr float kFarthestAzimuth = 1e6f;

  // For each of `count` coordinates, in the units of the axis: adds `step` times the node below it to `rows`,
  // sets `fractions` to the part of the way to the next node, 0 to 1, exactly 0 and 1 on nodes, and lowers
  // `codes` to the outcome on this axis. A coordinate that is not inside counts as the first node.
  // Outcomes and nodes are those of `Axis::Locate` exactly; fractions differ from its by 1e-6 at most.
  void Locate(const float* coordinates, std::size_t count, std::int32_t step, std::int32_t* rows,
              float* fractions, std::int32_t* codes) const;

  // Adds `step` times the node below each of `count` coordinates to `rows`; of coordinates that are not inside,
  // and of azimuths too far from 0, that of any node but the last, or of the only one.
  void AddLowerNodes(const float* coordinates, std::size_t count, std::int32_t step,
                     std::int32_t* rows) const;

  // What the kernels read.
  struct Nodes {
    std::vector<float> nodes;  // as they are
    std::vector<float>
        inverse_widths;  // 1 / distance of two neighbours, on a log scale that of their logarithms
    std::int32_t axis;   // Index(id)
    bool log;
    bool folded;   // azimuth
    bool endless;  // fetch
  };

 private:
  Nodes nodes_;
};

}  // namespace albtpu
