// The nodes of one tile of the surface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "quality/surface/node.h"
#include "quality/surface/point_tiles.h"

namespace albtpu::quality {

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
