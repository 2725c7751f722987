// The horizontal coordinate system of a LAS file, and the way from geographic coordinates into it by PROJ.
//
// Geographic coordinates are taken in the datum of the coordinate system, and no datum is transformed: the trajectory
// and the points of a survey were processed in one datum. The 1-2 m between ITRF and NAD83, were they mixed, would be
// 0.2 degrees of incidence at 400 m. No grids and no network are used.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/crs/proj_crs.h"
#include "formats/crs/user_projection.h"

namespace albtpu::formats {

// The statements of a LAS file and its user about the coordinate system. A code is 0 where nothing is stated.
struct CrsDescription {
  std::string user = {};  // --crs: EPSG:26917, well-known text, or whatever else PROJ reads. Overrides the rest.
  std::string wkt = {};   // Well-known text, record 2112.
  int projected = 0;      // GeoTIFF key 3072, an EPSG code.
  int geographic = 0;     // GeoTIFF key 2048, an EPSG code.
  int linear_unit = 0;    // GeoTIFF key 3076, an EPSG code; overrides the unit of `projected`.
  int vertical = 0;       // GeoTIFF key 4096, an EPSG code.
  int vertical_unit = 0;  // GeoTIFF key 4099, an EPSG code.

  UserProjection own = {};  // GeoTIFF keys of a projection without code.

  bool has_keys() const { return projected != 0 || geographic != 0 || own.has_projection(); }
  bool empty() const { return user.empty() && wkt.empty() && !has_keys(); }
};

struct GeographicPosition {
  double latitude = 0, longitude = 0;  // rad
};

struct MapPosition {
  double x = 0, y = 0;  // East and north, in the unit of the points.
};

// Converts differences of coordinates into metres and true directions: a step (dx, dy) on the map is
//     metres_per_x dx to grid east,  metres_per_y dy + north_per_x dx to grid north
// on the ground. Grid north is the direction of y, and grid east is perpendicular to it.
struct MapMetric {
  double metres_per_x = 1, metres_per_y = 1;
  double north_per_x = 0;  // 0 of a conformal projection, such as UTM: x and y are perpendicular on the ground.
  double convergence = 0;  // rad; true azimuth = grid azimuth + convergence.
};

// x - from; of longitudes, which repeat after `turn`, the short way round. `turn` is 0 on a map, where nothing repeats.
inline double DifferenceOfX(double x, double from, double turn) {
  return turn > 0 ? std::remainder(x - from, turn) : x - from;
}

// Immutable; any number of threads may use it at a time.
class MapFrame {
 public:
  // Tries the user's text, the well-known text, the EPSG code that the text ends with, and the GeoTIFF codes, in this
  // order. A text of a user that PROJ does not read is an error; so is a file of which nothing can be used. `name` is
  // the LAS file. FailedPrecondition where PROJ's database is the reason (CheckProjDatabase). Equal descriptions share
  // one frame, so that the files of a survey open PROJ's database once.
  static absl::StatusOr<std::shared_ptr<const MapFrame>> Create(const std::string& name,
                                                                const CrsDescription& description);
  ~MapFrame();

  const std::string& crs_name() const { return crs_name_; }  // "NAD83 / UTM zone 17N".
  // Well-known text (version 1 of GDAL) of its horizontal part. Empty if PROJ has none.
  const std::string& wkt() const { return wkt_; }
  // Of the heights, as far as it is stated; in metres, whatever their unit is.
  const std::optional<VerticalCrs>& vertical() const { return vertical_; }
  // For the user, about how the coordinate system was found; usually empty.
  const std::string& remark() const { return remark_; }
  bool is_geographic() const { return pipeline_.empty(); }
  bool is_transverse_mercator() const { return is_transverse_mercator_; }
  // Metres, or for geographic coordinates radians, in a unit of x and y.
  double unit() const { return unit_; }
  // 360 degrees in the unit of x, after which longitudes repeat; 0 on a map.
  double turn() const { return is_geographic() ? 2 * std::numbers::pi / unit_ : 0; }
  std::optional<double> metres_per_height_unit() const { return metres_per_height_unit_; }  // nullopt: not stated.
  const Ellipsoid& ellipsoid() const { return ellipsoid_; }

  // Equal lengths. Coordinates are not finite where the projection is not defined.
  void Project(std::span<const GeographicPosition> from, std::span<MapPosition> to) const;
  MapPosition Project(const GeographicPosition& position) const;

  // The inverse of Project; nullopt where the projection is not defined.
  std::optional<GeographicPosition> GeographicAt(const MapPosition& position) const;

  // From differences of the projection over 64 m, right to 1e-9. For a conformal projection metres_per_x and
  // metres_per_y are unit / scale.
  MapMetric MetricAt(const GeographicPosition& position) const;

 private:
  class Transformer;
  class Transformers;
  MapFrame();
  static absl::StatusOr<std::shared_ptr<const MapFrame>> CreateIn(ProjContext& context, const std::string& name,
                                                                  const CrsDescription& description);

  std::string crs_name_;
  std::string wkt_;
  std::optional<VerticalCrs> vertical_;
  std::string remark_;
  std::string pipeline_;       // Of PROJ, from geographic coordinates in its unit; empty for geographic points.
  double angular_unit_ = 0;    // rad in a unit of the geographic coordinates.
  double prime_meridian_ = 0;  // rad, longitude of the prime meridian.
  double unit_ = 1;
  double unit_factor_ = 1;  // Coordinates of PROJ in a unit of the points.
  bool is_transverse_mercator_ = false;
  std::optional<double> metres_per_height_unit_;
  Ellipsoid ellipsoid_;
  std::unique_ptr<Transformers> transformers_;
};

// FailedPrecondition when PROJ does not find its database of coordinate systems, or finds that of another program,
// which it cannot read: the message names it.
absl::Status CheckProjDatabase();

}  // namespace albtpu::formats
