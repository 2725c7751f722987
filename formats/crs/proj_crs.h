// A coordinate system of PROJ with the properties that MapFrame needs, and lengths on its ellipsoid. Only this file,
// user_projection.cc and map_frame.cc use PROJ.
#pragma once

#include <proj.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace albtpu::formats {

// Metres on the ellipsoid: the lengths of small differences of latitude and longitude on the ground.

struct Ellipsoid {
  double semi_major = 6378137.0;                            // m, WGS 84 and GRS 80: exact by definition.
  double eccentricity_squared = 0.00669437999014131699614;  // WGS 84, from 1/f = 298.257223563.

  // Radius of curvature in the meridian, M = a (1 - e^2) / (1 - e^2 sin^2 latitude)^(3/2), m.
  double MeridianRadius(double latitude) const {
    const double w = 1 - eccentricity_squared * std::sin(latitude) * std::sin(latitude);
    return semi_major * (1 - eccentricity_squared) / (w * std::sqrt(w));
  }
  // Radius of curvature in the prime vertical, N = a / sqrt(1 - e^2 sin^2 latitude), m.
  double PrimeVerticalRadius(double latitude) const {
    return semi_major / std::sqrt(1 - eccentricity_squared * std::sin(latitude) * std::sin(latitude));
  }
};

struct ProjDestroy {
  void operator()(PJ* object) const { proj_destroy(object); }
};
using ProjObject = std::unique_ptr<PJ, ProjDestroy>;

// A context without network whose messages are kept instead of printed. For one thread at a time.
class ProjContext {
 public:
  ProjContext();
  ~ProjContext();
  ProjContext(const ProjContext&) = delete;
  ProjContext& operator=(const ProjContext&) = delete;

  PJ_CONTEXT* get() const { return context_; }
  // FailedPrecondition when PROJ does not find its database of coordinate systems.
  absl::Status CheckDatabase() const;
  // FailedPrecondition when the database is one that this PROJ cannot read, such as that of another program's PROJ. The
  // message names it, and the variable of the environment that leads to it.
  absl::Status CheckLayout() const;
  // The last message of PROJ, for a message to the user.
  const std::string& last_message() const { return last_message_; }

 private:
  PJ_CONTEXT* context_;
  std::string last_message_;
};

// The vertical part of a coordinate system, restated for heights in metres, upwards.
struct VerticalCrs {
  std::string name, wkt;  // "NAVD88 height"; well-known text, version 1 of GDAL.
};

// The parts of a coordinate system, whether projected, geographic, compound, with three axes or with a datum shift.
struct ProjCrs {
  ProjObject horizontal;
  ProjObject geographic;  // The base of a projected system.
  std::string name, authority, code;
  bool is_projected = false;
  bool is_transverse_mercator = false;
  double unit = 1;            // m, or rad for geographic coordinates.
  double angular_unit = 0;    // rad, of the geographic coordinates.
  double prime_meridian = 0;  // rad
  Ellipsoid ellipsoid;
  std::optional<double> metres_per_height_unit;
  std::optional<VerticalCrs> vertical;
};

// The text as PROJ reads it: well-known text, a code, a name. InvalidArgument with the reason when it reads nothing, or
// no projected or geographic system.
absl::StatusOr<ProjCrs> ReadCrs(ProjContext& context, const std::string& text);

// Metres in a unit of length, by its EPSG code.
std::optional<double> MetresOfUnit(ProjContext& context, int code);

// Metres in a unit of a vertical coordinate system, by its EPSG code.
std::optional<double> MetresOfVerticalCrs(ProjContext& context, int code);

// A vertical coordinate system by its EPSG code, or by that of its datum, as GeoTIFF 1.0 has it.
std::optional<VerticalCrs> VerticalCrsOf(ProjContext& context, int code);

// The code of AUTHORITY["EPSG","26917"] or ID["EPSG",26917] with which a well-known text ends; nullopt if it has none.
std::optional<int> LastEpsgCode(const std::string& wkt);

}  // namespace albtpu::formats
