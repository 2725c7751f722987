// A map projection of a file's own, by GeoTIFF keys: UTM or transverse Mercator on an ellipsoid.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "absl/status/statusor.h"

namespace albtpu::formats {

class ProjContext;

struct TransverseMercator {
  double latitude = 0, longitude = 0;            // Of the natural origin, degree.
  double scale = 1;                              // At the natural origin.
  double false_easting = 0, false_northing = 0;  // In the unit of the map.
};

// Parts that a file does not state are absent. No datum is transformed, so that the ellipsoid is all of it that counts.
struct UserProjection {
  int utm_zone = 0;  // 1 to 60; negative: of the southern hemisphere; 0: none.
  std::optional<TransverseMercator> transverse_mercator;
  int geographic = 0;                                    // EPSG code of the geographic coordinates; or
  int ellipsoid = 0;                                     // that of the ellipsoid; or
  std::optional<double> semi_major, inverse_flattening;  // its parameters, m and 1.
  double prime_meridian = 0;                             // degree from Greenwich.

  bool has_projection() const { return utm_zone != 0 || transverse_mercator.has_value(); }
  std::string Key() const;  // Equal for equal ones.
};

// Its well-known text, in a unit of `metres`. InvalidArgument where the ellipsoid is not stated or PROJ does not know
// it.
absl::StatusOr<std::string> WktOf(ProjContext& context, const UserProjection& projection, double metres);

}  // namespace albtpu::formats
