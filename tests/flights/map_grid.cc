#include "tests/flights/map_grid.h"

#include <cassert>
#include <cmath>

#include "tests/flights/ellipsoid.h"

namespace albtpu::testing {
namespace {

constexpr double kSurveyFoot = 1200.0 / 3937.0;  // m, exact (US Metric Law of 1866).

// By its parameters: the programs find theirs by codes and well-known text.
std::shared_ptr<PJ> Projection(const std::string& parameters) {
  std::shared_ptr<PJ> projection(proj_create(PJ_DEFAULT_CTX, parameters.c_str()), &proj_destroy);
  assert(projection != nullptr);
  return projection;
}

MapGrid UtmNorth(int zone) {
  const int meridian = 6 * zone - 183;
  const std::string number = std::to_string(zone), unit = R"(UNIT["metre",1,AUTHORITY["EPSG","9001"]])";
  return {.projection = Projection("+proj=utm +zone=" + number + " +ellps=WGS84"),
          .epsg = 32600 + zone,
          .wkt = R"(PROJCS["WGS 84 / UTM zone )" + number +
                 R"(N",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],)"
                 R"(PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],)"
                 R"(PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],)"
                 R"(PARAMETER["central_meridian",)" +
                 std::to_string(meridian) +
                 R"(],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],)"
                 R"(PARAMETER["false_northing",0],)" +
                 unit + R"(,AXIS["Easting",EAST],AXIS["Northing",NORTH],AUTHORITY["EPSG",")" +
                 std::to_string(32600 + zone) + R"("]])",
          .vertical_wkt = R"(VERT_CS["NAVD88 height",VERT_DATUM["North American Vertical Datum 1988",2005],)" + unit +
                          R"(,AXIS["Gravity-related height",UP],AUTHORITY["EPSG","5703"]])"};
}

MapGrid FloridaEastFeet() {
  const std::string unit = R"(UNIT["US survey foot",0.304800609601219,AUTHORITY["EPSG","9003"]])";
  return {.projection = Projection("+proj=tmerc +lat_0=24.3333333333333333 +lon_0=-81 +k_0=0.999941177 "
                                   "+x_0=200000.00010160020 +ellps=GRS80"),  // 656 166.667 feet.
          .metres_per_unit = kSurveyFoot,
          .epsg = 2236,
          .linear_unit = 9003,
          .wkt = R"wkt(PROJCS["NAD83 / Florida East (ftUS)",GEOGCS["NAD83",DATUM["North_American_Datum_1983",)wkt"
                 R"(SPHEROID["GRS 1980",6378137,298.257222101]],PRIMEM["Greenwich",0],)"
                 R"(UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],)"
                 R"(PARAMETER["latitude_of_origin",24.3333333333333],PARAMETER["central_meridian",-81],)"
                 R"(PARAMETER["scale_factor",0.999941177],PARAMETER["false_easting",656166.667],)"
                 R"(PARAMETER["false_northing",0],)" +
                 unit + R"(,AXIS["Easting",EAST],AXIS["Northing",NORTH],AUTHORITY["EPSG","2236"]])",
          .vertical_wkt = R"wkt(VERT_CS["NAVD88 height (ftUS)",)wkt"
                          R"(VERT_DATUM["North American Vertical Datum 1988",2005],)" +
                          unit + R"(,AXIS["Gravity-related height",UP],AUTHORITY["EPSG","6360"]])"};
}

MapGrid LaeaEurope() {
  const std::string unit = R"(UNIT["metre",1,AUTHORITY["EPSG","9001"]])";
  return {.projection = Projection("+proj=laea +lat_0=52 +lon_0=10 +x_0=4321000 +y_0=3210000 +ellps=GRS80"),
          .epsg = 3035,
          .wkt = R"wkt(PROJCS["ETRS89-extended / LAEA Europe",GEOGCS["ETRS89",)wkt"
                 R"(DATUM["European_Terrestrial_Reference_System_1989",SPHEROID["GRS 1980",6378137,298.257222101]],)"
                 R"(PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],)"
                 R"(PROJECTION["Lambert_Azimuthal_Equal_Area"],PARAMETER["latitude_of_center",52],)"
                 R"(PARAMETER["longitude_of_center",10],PARAMETER["false_easting",4321000],)"
                 R"(PARAMETER["false_northing",3210000],)" +
                 unit + R"(,AXIS["Easting",EAST],AXIS["Northing",NORTH],AUTHORITY["EPSG","3035"]])",
          .vertical_wkt = UtmNorth(17).vertical_wkt};
}

MapGrid Geographic() {
  return {.epsg = 4326,
          .wkt = R"(GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],)"
                 R"(PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433],AUTHORITY["EPSG","4326"]])",
          .vertical_wkt = UtmNorth(17).vertical_wkt};
}

}  // namespace

GridPoint MapGrid::At(double latitude, double longitude) const {
  if (projection == nullptr) {
    const double degrees = std::remainder(longitude / kDegree, 360);
    return {.x = from_zero && degrees < 0 ? degrees + 360 : degrees, .y = latitude / kDegree};
  }
  const PJ_COORD place = proj_coord(longitude, latitude, 0, 0);
  const PJ_COORD point = proj_trans(projection.get(), PJ_FWD, place);
  const PJ_FACTORS factors = proj_factors(projection.get(), place);
  return {point.xy.x / metres_per_unit, point.xy.y / metres_per_unit, factors.meridian_convergence,
          factors.meridional_scale};
}

std::string MapGrid::LasWkt(bool orthometric) const {
  if (!orthometric && metres_per_unit == 1) return wkt;
  return R"(COMPD_CS["horizontal and height",)" + wkt + "," + vertical_wkt + "]";
}

std::optional<MapGrid> FindMapGrid(std::string_view name) {
  for (const int zone : {16, 17, 18})
    if (name == "utm" + std::to_string(zone) + "n") return UtmNorth(zone);
  if (name == "geographic") return Geographic();
  if (name == "geographic-360") {
    MapGrid grid = Geographic();
    grid.from_zero = true;
    return grid;
  }
  if (name == "laea-europe") return LaeaEurope();
  if (name == "florida-east-ft") return FloridaEastFeet();
  return std::nullopt;
}

}  // namespace albtpu::testing
