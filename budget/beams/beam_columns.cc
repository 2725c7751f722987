#include "budget/beams/beam_columns.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

#include "budget/beams/arctangent.h"
#include "budget/beams/refracted_path.h"

// The code below is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "budget/beams/beam_columns.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef ALBTPU_BUDGET_BEAM_BLOCK
#define ALBTPU_BUDGET_BEAM_BLOCK
namespace albtpu {
namespace {

// Small enough for all columns of a block to stay in the first-level cache.
constexpr std::size_t kBlock = 128;
using Column = double[kBlock];

struct Block {
  Column east, north, height, depth, convergence;      // As in PointColumns.
  Column incidence, azimuth, slant_range, water_path;  // As in BeamColumns.
};

}  // namespace
}  // namespace albtpu
#endif

HWY_BEFORE_NAMESPACE();
namespace albtpu {
namespace HWY_NAMESPACE {
namespace {

// `turn` plus the convergence, folded into [0, 2 pi). The second comparison is not "else": a tiny negative number plus
// 2 pi rounds to 2 pi.
HWY_INLINE double TrueAzimuth(double turn, double convergence) {
  constexpr double kFullTurn = 2 * std::numbers::pi;
  const double azimuth = turn + convergence;
  const double positive = azimuth < 0 ? azimuth + kFullTurn : azimuth;
  return positive >= kFullTurn ? positive - kFullTurn : positive;
}

// Plain loops, which the compiler turns into vectors. Steps of different pulses overlap; those of one pulse wait for
// each other, so there is one loop for each step.
void ComputeBlock(const StillWater& water, Block& block) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  Column distance, height, depth, in_air, least, tangent;
  for (std::size_t i = 0; i < kBlock; ++i) {
    const double east = block.east[i], north = block.north[i];
    block.azimuth[i] = TrueAzimuth(Arctangent(east, north), block.convergence[i]);
    distance[i] = std::sqrt(east * east + north * north);
    height[i] = block.height[i] > 0 ? block.height[i] : kNone;
    depth[i] = block.depth[i] <= 0 ? 0.0 : block.depth[i];
    // Vertically, from the sensor to where the path in air ends.
    in_air[i] = block.depth[i] <= 0 ? height[i] + block.depth[i] : height[i];
    least[i] = MinTangent(distance[i], height[i], depth[i], water);
    tangent[i] = least[i];
  }
  for (int step = 0; step < kRefractionSteps; ++step)
    for (std::size_t i = 0; i < kBlock; ++i)
      tangent[i] = NextTangent(tangent[i], least[i], distance[i], height[i], depth[i], water);
  for (std::size_t i = 0; i < kBlock; ++i) {
    const double crossing = DistanceAt(tangent[i], distance[i], height[i]);
    const double r = block.depth[i] <= 0 ? distance[i] : crossing;
    const double rest = distance[i] - r;
    block.incidence[i] = Arctangent(r, in_air[i]);
    block.slant_range[i] = std::sqrt(r * r + in_air[i] * in_air[i]);
    block.water_path[i] = std::sqrt(rest * rest + depth[i] * depth[i]);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace albtpu
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace albtpu {
namespace {

HWY_EXPORT(ComputeBlock);

// The rows from `begin` on; a constant is repeated, and none is 0.
void Read(std::span<const double> column, std::size_t begin, std::size_t count, Column& block) {
  if (column.size() <= 1)
    std::fill_n(block, count, column.empty() ? 0.0 : column[0]);
  else
    std::copy_n(column.data() + begin, count, block);
}

void Write(const Column& block, std::size_t begin, std::size_t count, std::span<double> column) {
  if (!column.empty()) std::copy_n(block, count, column.data() + begin);
}

}  // namespace

void ComputeBeams(const PointColumns& points, double index, const BeamColumns& beams) {
  const std::size_t size = points.east.size();
  assert(index >= 1);
  assert(points.north.size() == size && points.height.size() == size && points.depth.size() == size);
  assert(points.convergence.size() <= 1 || points.convergence.size() == size);
  const StillWater water(index);
  Block block = {};  // Rows that the last block does not fill are computed, but not written.
  for (std::size_t begin = 0; begin < size; begin += kBlock) {
    const std::size_t count = std::min(kBlock, size - begin);
    Read(points.east, begin, count, block.east);
    Read(points.north, begin, count, block.north);
    Read(points.height, begin, count, block.height);
    Read(points.depth, begin, count, block.depth);
    Read(points.convergence, begin, count, block.convergence);
    HWY_DYNAMIC_DISPATCH(ComputeBlock)(water, block);
    Write(block.incidence, begin, count, beams.incidence);
    Write(block.azimuth, begin, count, beams.azimuth);
    Write(block.slant_range, begin, count, beams.slant_range);
    Write(block.water_path, begin, count, beams.water_path);
  }
}

}  // namespace albtpu
#endif  // HWY_ONCE
