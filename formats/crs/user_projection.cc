#include "formats/crs/user_projection.h"

#include <proj.h>

#include <cmath>
#include <cstdlib>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "formats/crs/proj_crs.h"
#include "sea/angle.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

absl::Status NoEllipsoid() {
  return absl::InvalidArgumentError("its own projection is on an ellipsoid that is not stated, or not known");
}

// The ellipsoid, and its prime meridian in degrees.
struct Globe {
  double semi_major = 0, inverse_flattening = 0, prime_meridian = 0;
};

absl::StatusOr<Globe> GlobeOf(ProjContext& context, const UserProjection& projection) {
  Globe globe = {projection.semi_major.value_or(0), projection.inverse_flattening.value_or(0),
                 projection.prime_meridian};
  if (projection.geographic != 0) {
    const absl::StatusOr<ProjCrs> known = ReadCrs(context, absl::StrCat("EPSG:", projection.geographic));
    if (!known.ok()) return NoEllipsoid();
    globe = {known->ellipsoid.semi_major, 1 / (1 - std::sqrt(1 - known->ellipsoid.eccentricity_squared)),
             DegreesOfRadians(known->prime_meridian)};
  } else if (projection.ellipsoid != 0) {
    const ProjObject ellipsoid(proj_create_from_database(
        context.get(), "EPSG", absl::StrCat(projection.ellipsoid).c_str(), PJ_CATEGORY_ELLIPSOID, 0, nullptr));
    if (ellipsoid == nullptr || !proj_ellipsoid_get_parameters(context.get(), ellipsoid.get(), &globe.semi_major,
                                                               nullptr, nullptr, &globe.inverse_flattening))
      return NoEllipsoid();
  }
  // Of the earth; a sphere has none.
  const bool is_known = globe.semi_major > 6.3e6 && globe.semi_major < 6.4e6 && globe.inverse_flattening > 250 &&
                        globe.inverse_flattening < 350;
  if (!is_known) return NoEllipsoid();
  return globe;
}

std::string NameOf(const UserProjection& projection) {
  const int zone = projection.utm_zone;
  if (zone != 0) return absl::StrFormat("UTM zone %d%s", zone < 0 ? -zone : zone, zone < 0 ? "S" : "N");
  return absl::StrFormat("transverse Mercator around %.6g degrees", projection.transverse_mercator->longitude);
}

// UTM by its definition, in a unit of `metres`.
TransverseMercator Utm(int zone, double metres) {
  return {.latitude = 0,
          .longitude = 6.0 * std::abs(zone) - 183,
          .scale = 0.9996,
          .false_easting = 500e3 / metres,
          .false_northing = zone < 0 ? 10e6 / metres : 0};
}

}  // namespace

std::string UserProjection::Key() const {
  std::string key = absl::StrFormat("%d,%d,%d,%.17g,%.17g,%.17g", utm_zone, geographic, ellipsoid,
                                    semi_major.value_or(0), inverse_flattening.value_or(0), prime_meridian);
  if (transverse_mercator.has_value()) {
    const TransverseMercator& map = *transverse_mercator;
    absl::StrAppendFormat(&key, ",%.17g,%.17g,%.17g,%.17g,%.17g", map.latitude, map.longitude, map.scale,
                          map.false_easting, map.false_northing);
  }
  return key;
}

absl::StatusOr<std::string> WktOf(ProjContext& context, const UserProjection& projection, double metres) {
  ASSIGN_OR_RETURN(const Globe globe, GlobeOf(context, projection));
  const TransverseMercator map =
      projection.utm_zone != 0 ? Utm(projection.utm_zone, metres) : *projection.transverse_mercator;
  return absl::StrFormat(
      "PROJCS[\"%s\",GEOGCS[\"of the file\",DATUM[\"of the file\",SPHEROID[\"of the file\",%.17g,%.17g]],"
      "PRIMEM[\"of the file\",%.17g],UNIT[\"degree\",%.17g]],PROJECTION[\"Transverse_Mercator\"],"
      "PARAMETER[\"latitude_of_origin\",%.17g],PARAMETER[\"central_meridian\",%.17g],"
      "PARAMETER[\"scale_factor\",%.17g],PARAMETER[\"false_easting\",%.17g],"
      "PARAMETER[\"false_northing\",%.17g],UNIT[\"%s\",%.17g]]",
      NameOf(projection), globe.semi_major, globe.inverse_flattening, globe.prime_meridian, RadiansOfDegrees(1.0),
      map.latitude, map.longitude, map.scale, map.false_easting, map.false_northing,
      metres == 1 ? "metre" : "unit of the map", metres);
}

}  // namespace albtpu::formats
