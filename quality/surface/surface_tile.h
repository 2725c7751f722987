// The nodes of one tile of the surface.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "quality/surface/node.h"
#include "quality/surface/point_tiles.h"

namespace albtpu::quality {

// One node, in the middle of its cell. Variances at 1 sigma, m^2.
struct SurfaceNode {
  std::uint32_t points = 0;                                     // That its height is made of; 0: no node.
  std::uint32_t left_out = 0;                                   // Beyond kFarthest standard deviations.
  double elevation = std::numeric_limits<double>::quiet_NaN();  // m, upwards, in the datum of the points
  NodeVariance variance;
  double bias = 0;                                                   // m, of the elevation: the mean of its points
  double deviation = std::numeric_limits<double>::quiet_NaN();       // m, of the points from the plane; of one: NaN
  double shoalest = std::numeric_limits<double>::quiet_NaN();        // m: the highest of the points, upwards
  double shoalest_sigma = std::numeric_limits<double>::quiet_NaN();  // m, of its height
  float depth = 0;                                                   // m, of the water: the mean of the points
  float thu = 0;                                                     // m, 95 %: the mean of the points
  float slope_x = 0, slope_y = 0;                                    // m per m
};

inline constexpr double kFarthest = 6;

// Of kTileCells rows from the south, each of kTileCells nodes. `points` are those of PointTiles::Read, `cell` is the
// side in the units of the map, of which one has `metres_per_unit`.
//
// A plane through the 3 x 3 cells around a node takes the slope away, and brings the mean of the cell's points to the
// middle of the cell. First, a plane through the medians of these cells and the deviations from it tell points that lie
// beyond kFarthest standard deviations: the stated ones, or 1.48 times the median deviation of the cell where the
// bottom is rougher.
std::vector<SurfaceNode> NodesOf(const TilePlace& tile, std::vector<SurfacePoint> points, double cell,
                                 double metres_per_unit, const NodeSources& sources);

}  // namespace albtpu::quality
