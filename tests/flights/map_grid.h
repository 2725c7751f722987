// The coordinate systems that simulated surveys are delivered in.
#pragma once

#include <proj.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace albtpu::testing {

// A place in the horizontal coordinates of a grid.
struct GridPoint {
  double x = 0, y = 0;     // Units of the grid.
  double convergence = 0;  // rad, true azimuth of the direction of y
  double scale = 1;        // m on the map for a metre on the ellipsoid; 1 for geographic coordinates
};

struct MapGrid {
  std::shared_ptr<PJ> projection = {};  // PROJ's, in metres. None: longitude and latitude in degrees.
  bool from_zero = false;               // Longitudes are 0 to 360 degrees, not -180 to 180.
  double metres_per_unit = 1;           // Of projected coordinates, and of all heights.
  int epsg = 0;                         // Of the horizontal coordinates.
  int linear_unit = 9001;               // EPSG code of the unit.
  std::string wkt;                      // Well-known text 1 of the horizontal coordinates.
  std::string vertical_wkt;             // VERT_CS of orthometric heights (NAVD 88) in the unit of the heights.

  GridPoint At(double latitude, double longitude) const;

  // What a LAS file has in its record 2112: with heights in feet or above the geoid, a compound system.
  std::string LasWkt(bool orthometric) const;
};

// "utm16n", "utm17n", "utm18n": metres, WGS 84. "geographic", "geographic-360": degrees, WGS 84. "laea-europe": EPSG
// 3035, metres, whose x and y are not perpendicular on the ground. "florida-east-ft": EPSG 2236, US survey
// feet, NAD 83, whose coordinates are taken as equal to those of WGS 84: 1-2 m in reality, of points and trajectory
// alike.
std::optional<MapGrid> FindMapGrid(std::string_view name);

}  // namespace albtpu::testing
