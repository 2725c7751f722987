#include "formats/crs/map_frame.h"

#include <gmock/gmock.h>
#include <stdlib.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <thread>

#include "formats/crs/proj_crs.h"
#include "tests/degree.h"

namespace albtpu::formats {
namespace {

using ::testing::HasSubstr;

using albtpu::testing::kDegree;
constexpr double kUsFoot = 1200.0 / 3937;  // m, exact.

// As a real file of 2016 has it: metres as the unit of angles, and a height among the axes of a projected system.
constexpr char kFaultyWkt[] =
    R"(PROJCS["NAD83 / UTM zone 17N",GEOGCS["NAD83 / UTM zone 17N",DATUM["NAD83",SPHEROID["GRS80",)"
    R"(6378137.000,298.257222100,AUTHORITY["EPSG","0"]],AUTHORITY["EPSG","0"]],PRIMEM["Greenwich",0.0,)"
    R"(AUTHORITY["EPSG","8901"]],UNIT["Meter",1.00000000000000000000,AUTHORITY["EPSG","9001"]],)"
    R"(AUTHORITY["EPSG","26917"]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0.0],)"
    R"(PARAMETER["central_meridian",-81.0],PARAMETER["scale_factor",0.9996],)"
    R"(PARAMETER["false_easting",500000],PARAMETER["false_northing",0.000],UNIT["Meter",1.0,)"
    R"(AUTHORITY["EPSG","9001"]],AXIS["Easting",EAST],AXIS["Northing",NORTH],AXIS["Height",UP],)"
    R"(AUTHORITY["EPSG","26917"]])";

std::shared_ptr<const MapFrame> Frame(const CrsDescription& description) {
  auto frame = MapFrame::Create("in.las", description);
  return frame.ok() ? *frame : nullptr;
}
std::shared_ptr<const MapFrame> UserFrame(const std::string& text) { return Frame({.user = text}); }
std::string Refusal(const CrsDescription& description) {
  return std::string(MapFrame::Create("in.las", description).status().message());
}
GeographicPosition At(double latitude, double longitude) { return {latitude * kDegree, longitude * kDegree}; }

TEST(ProjContext, HasNoNetwork) {
  setenv("PROJ_NETWORK", "ON", 1);
  const ProjContext context;
  unsetenv("PROJ_NETWORK");
  EXPECT_EQ(proj_context_is_network_enabled(context.get()), 0);
}

// The azimuth of a short step on the map, plus the convergence, is the azimuth of the step on the ground; its length in
// metres is that of the step.
void ExpectTrueDirections(const MapFrame& frame, const GeographicPosition& position) {
  const MapMetric metric = frame.MetricAt(position);
  const Ellipsoid& ellipsoid = frame.ellipsoid();
  const double meridian = ellipsoid.MeridianRadius(position.latitude);
  const double parallel = ellipsoid.PrimeVerticalRadius(position.latitude) * std::cos(position.latitude);
  for (double azimuth = 0; azimuth < 2 * std::numbers::pi; azimuth += 0.5) {
    // From 50 m behind to 50 m ahead: the second derivatives cancel.
    const double north = 50 * std::cos(azimuth) / meridian, east = 50 * std::sin(azimuth) / parallel;
    const MapPosition ahead = frame.Project({position.latitude + north, position.longitude + east});
    const MapPosition behind = frame.Project({position.latitude - north, position.longitude - east});
    const double x = (ahead.x - behind.x) * metric.metres_per_x;
    const double y = (ahead.y - behind.y) * metric.metres_per_y + (ahead.x - behind.x) * metric.north_per_x;
    // Third derivatives: (50 m / R)^2 = 6e-11 of it, times 10 for tangents; rounding: 1e-9 m of 100 m.
    EXPECT_NEAR(std::hypot(x, y), 100, 1e-6);
    EXPECT_NEAR(std::remainder(std::atan2(x, y) + metric.convergence - azimuth, 2 * std::numbers::pi), 0, 1e-8)
        << azimuth;
  }
}

TEST(MapFrame, ProjectsIntoUtm) {
  const auto frame = UserFrame("EPSG:26917");
  EXPECT_EQ(frame->crs_name(), "NAD83 / UTM zone 17N");
  EXPECT_EQ(frame->unit(), 1);
  EXPECT_TRUE(frame->is_transverse_mercator());
  EXPECT_FALSE(frame->metres_per_height_unit().has_value());
  const MapPosition origin = frame->Project(At(0, -81));
  EXPECT_NEAR(origin.x, 500000, 1e-6);
  EXPECT_NEAR(origin.y, 0, 1e-6);
  // The arc of the meridian from the equator to 45 degrees is 4 984 944.378 m on GRS 80.
  EXPECT_NEAR(frame->Project(At(45, -81)).y, 0.9996 * 4984944.378, 1e-3);
}

// Series of the transverse Mercator projection in w = difference of longitude, with t = tan(latitude),
// eta^2 = e'^2 cos^2(latitude) (Snyder 1987, Map Projections: A Working Manual, USGS PP 1395, eq. 8-11):
//     k = k0 (1 + (1 + eta^2) A^2 / 2 + (5 - 4 t^2 + 42 eta^2 ...) A^4 / 24),  A = w cos(latitude)
//     convergence = w sin(latitude) (1 + A^2 (1 + 3 eta^2 + 2 eta^4) / 3 + ...)
TEST(MapFrame, HasTheConvergenceAndScaleOfTheSeries) {
  const auto frame = UserFrame("EPSG:32617");
  for (const double latitude : {-60.0, -20.0, 1.0, 30.0, 45.0, 60.0}) {
    for (const double longitude : {-84.0, -82.0, -81.0, -80.0, -78.0}) {
      const double phi = latitude * kDegree, w = (longitude + 81) * kDegree;
      const double eta2 = 0.00673949674 * std::cos(phi) * std::cos(phi);
      const double t2 = std::tan(phi) * std::tan(phi);
      const double a2 = w * w * std::cos(phi) * std::cos(phi);
      const double scale = 0.9996 * (1 + (1 + eta2) * a2 / 2 + (5 - 4 * t2) * a2 * a2 / 24);
      const double convergence = w * std::sin(phi) * (1 + a2 * (1 + 3 * eta2 + 2 * eta2 * eta2) / 3);
      const MapMetric metric = frame->MetricAt(At(latitude, longitude));
      // What is left out: 42 eta^2 a^4 / 24 = 0.012 a^4 with a^2 < 2.7e-3, so 1e-7; w a^4 (2 - t^2) / 15 = 4e-8.
      EXPECT_NEAR(metric.metres_per_x, 1 / scale, 2e-7);
      EXPECT_NEAR(metric.metres_per_y, 1 / scale, 2e-7);
      EXPECT_NEAR(metric.convergence, convergence, 1e-7) << latitude << " " << longitude;
    }
  }
}

TEST(MapFrame, KeepsTrueDirectionsAndLengths) {
  for (const char* crs : {"EPSG:32617", "EPSG:26917", "EPSG:2236", "EPSG:2154", "EPSG:28992", "EPSG:4269", "EPSG:3413",
                          "EPSG:3035", "EPSG:5070"}) {
    const auto frame = UserFrame(crs);
    const std::string name = crs;
    const GeographicPosition position = name == "EPSG:2154"    ? At(48, -4.5)
                                        : name == "EPSG:28992" ? At(53, 4.8)
                                        : name == "EPSG:3413"  ? At(71, -156)
                                        : name == "EPSG:3035"  ? At(34.6, 33.1)
                                                               : At(26, -83.9);
    SCOPED_TRACE(crs);
    ExpectTrueDirections(*frame, position);
  }
}

// Snyder (1987), section 24: an equal-area azimuthal projection stretches lengths across the radius from its centre by
// 1 / cos(c / 2), c away from it, and shortens those along it as much; here on a sphere. A unit of y, at the angle
// `theta` from the radius, is hypot(cos(theta) k, sin(theta) / k) m long, with k = 1 / cos(c / 2), and so on.
TEST(MapFrame, HasTheSkewOfAnEqualAreaProjection) {
  const auto frame = UserFrame("+proj=laea +lat_0=0 +lon_0=0 +R=6371000 +type=crs");
  const MapMetric metric = frame->MetricAt(At(0, 40));
  const double k = 1 / std::cos(20 * kDegree);
  EXPECT_NEAR(metric.metres_per_x, k, 1e-8);  // Along the radius.
  EXPECT_NEAR(metric.metres_per_y, 1 / k, 1e-8);
  EXPECT_EQ(metric.north_per_x, 0);
  const MapPosition at = {3e6, 3e6};
  const GeographicPosition position = frame->GeographicAt(at).value();
  const MapMetric skew = frame->MetricAt(position);
  const double half = std::asin(std::hypot(at.x, at.y) / (2 * 6371000)), k2 = std::pow(1 / std::cos(half), 2);
  // Of unit vectors to x and y, each with the half of a square along the radius and half across.
  const double length = std::sqrt((k2 + 1 / k2) / 2), inner = (k2 - 1 / k2) / 2;
  EXPECT_NEAR(skew.metres_per_y, length, 1e-8);
  EXPECT_NEAR(skew.north_per_x, inner / length, 1e-8);
  EXPECT_NEAR(skew.metres_per_x, 1 / length, 1e-8);  // Areas are kept.
}

TEST(MapFrame, TurnsGridNorthByThreeDegreesAtTheEdgeOfAZone) {
  const MapMetric metric = UserFrame("EPSG:32617")->MetricAt(At(60, -78));
  EXPECT_NEAR(metric.convergence / kDegree, 3 * std::sin(60 * kDegree), 0.01);
}

TEST(MapFrame, ProjectsIntoFeet) {
  const auto feet = UserFrame("EPSG:2236");     // NAD83 / Florida East (ftUS)
  const auto metres = UserFrame("EPSG:26958");  // NAD83 / Florida East
  EXPECT_NEAR(feet->unit(), kUsFoot, 1e-12);
  const GeographicPosition position = At(26.1, -80.4);
  // Their false eastings are 656 166.667 feet and 200 000 m.
  EXPECT_NEAR((feet->Project(position).x - 656166.667) * kUsFoot, metres->Project(position).x - 200000, 1e-6);
  EXPECT_NEAR(feet->Project(position).y * kUsFoot, metres->Project(position).y, 1e-6);
  EXPECT_NEAR(feet->MetricAt(position).metres_per_x, kUsFoot * metres->MetricAt(position).metres_per_x, 1e-10);
}

TEST(MapFrame, KeepsGeographicCoordinates) {
  const auto frame = UserFrame("EPSG:4269");
  EXPECT_TRUE(frame->is_geographic());
  const MapPosition position = frame->Project(At(26, -81.5));
  EXPECT_DOUBLE_EQ(position.x, -81.5);
  EXPECT_DOUBLE_EQ(position.y, 26);
  const MapMetric metric = frame->MetricAt(At(0, 10));
  // A degree of the equator, and of the meridian there: a (1 - e^2) pi / 180.
  EXPECT_NEAR(metric.metres_per_x, 6378137 * kDegree, 1e-6);
  EXPECT_NEAR(metric.metres_per_y, 6378137 * (1 - 0.00669438002290) * kDegree, 1e-5);
  EXPECT_EQ(metric.convergence, 0);
  EXPECT_DOUBLE_EQ(frame->Project(At(26, 278.5)).x, -81.5);
}

TEST(MapFrame, UsesTheCodeOfFaultyText) {
  const auto frame = Frame({.wkt = kFaultyWkt});
  ASSERT_NE(frame, nullptr);
  EXPECT_THAT(frame->remark(), HasSubstr("its code, EPSG:26917, is used"));
  EXPECT_EQ(frame->metres_per_height_unit(), 1.0);
  const auto right = UserFrame("EPSG:26917");
  EXPECT_EQ(frame->Project(At(26, -81.5)).x, right->Project(At(26, -81.5)).x);
}

TEST(MapFrame, UsesGeoKeysWhereTheTextIsFaultyAndHasNoCode) {
  std::string wkt = kFaultyWkt;
  wkt.erase(wkt.rfind(",AUTHORITY"));
  wkt += "]";
  const auto frame = Frame({.wkt = wkt, .projected = 26917});
  ASSERT_NE(frame, nullptr);
  EXPECT_THAT(frame->remark(), HasSubstr("its GeoTIFF code, EPSG:26917, is used"));
  EXPECT_THAT(Refusal({.wkt = wkt}), HasSubstr("a unit that is not an angle); name it by --crs"));
}

TEST(MapFrame, UsesTheCodeOfTextThatCannotBeRead) {
  const auto frame = Frame({.wkt = R"(PROJCS["x",PROJECTION["none"],AUTHORITY["EPSG","32617"] ] )"});
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->crs_name(), "WGS 84 / UTM zone 17N");
  EXPECT_FALSE(frame->remark().empty());
}

TEST(MapFrame, ReadsTextWithoutRemark) {
  const auto frame = Frame({.wkt = R"wkt(COMPD_CS["NAD83(2011) / UTM zone 17N + NAVD88 height (ftUS)",
    PROJCS["NAD83(2011) / UTM zone 17N",GEOGCS["NAD83(2011)",
    DATUM["NAD83_National_Spatial_Reference_System_2011",SPHEROID["GRS 1980",6378137,298.257222101]],
    PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],
    PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",-81],
    PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],
    UNIT["metre",1]],VERT_CS["NAVD88 height (ftUS)",VERT_DATUM["North American Vertical Datum 1988",2005],
    UNIT["US survey foot",0.304800609601219],AXIS["Up",UP]]])wkt"});
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->remark(), "");
  EXPECT_NEAR(frame->metres_per_height_unit().value(), kUsFoot, 1e-12);
  EXPECT_NEAR(frame->Project(At(0, -81)).x, 500000, 1e-6);
  EXPECT_EQ(frame->vertical()->name, "NAVD88 height");
}

// With the code of the system in metres, without which GeoTIFF does not keep it.
TEST(MapFrame, RestatesHeightsInFeetInMetres) {
  const std::pair<int, int> twins[] = {{6360, 5703}, {8228, 5703}, {5702, 7968}, {8050, 5714}, {5703, 5703}};
  for (const auto& [code, in_metres] : twins) {
    const auto frame = Frame({.projected = 26917, .vertical = code});
    ASSERT_TRUE(frame->vertical().has_value()) << code;
    EXPECT_EQ(LastEpsgCode(frame->vertical()->wkt), in_metres) << code;
    EXPECT_THAT(frame->vertical()->wkt, HasSubstr("UNIT[\"metre\",1")) << code;
  }
  EXPECT_EQ(Frame({.projected = 26917, .vertical = 5103})->vertical()->name, "NAVD88 height");  // Its datum.
  const auto own = Frame({.wkt = R"wkt(COMPD_CS["a",PROJCS["NAD83 / UTM zone 17N",GEOGCS["NAD83",DATUM["NAD83",
    SPHEROID["GRS 1980",6378137,298.257222101]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],
    PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",-81],
    PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],
    UNIT["metre",1]],VERT_CS["of the mine",VERT_DATUM["Datum of Mine",2005],UNIT["foot",0.3048],AXIS["Up",UP]]])wkt"});
  EXPECT_EQ(own->vertical()->name, "Datum of Mine height");
}

TEST(MapFrame, ReadsGeoKeys) {
  const auto frame = Frame({.projected = 26917, .linear_unit = 9003, .vertical_unit = 9001});
  EXPECT_NEAR(frame->unit(), kUsFoot, 1e-12);
  EXPECT_NEAR(frame->Project(At(0, -81)).x * kUsFoot, 500000, 1e-6);
  EXPECT_NEAR(frame->MetricAt(At(0, -81)).metres_per_x, kUsFoot / 0.9996, 1e-8);
  EXPECT_EQ(frame->metres_per_height_unit(), 1.0);
  EXPECT_NEAR(Frame({.projected = 26917, .vertical = 6360})->metres_per_height_unit().value(), kUsFoot, 1e-12);
  EXPECT_TRUE(Frame({.geographic = 4269})->is_geographic());
  EXPECT_THAT(Refusal({.projected = 60000}), HasSubstr("in.las: its coordinate system cannot be used"));
}

TEST(MapFrame, PrefersWhatTheUserSays) {
  EXPECT_EQ(Frame({.user = "EPSG:32618", .wkt = kFaultyWkt})->crs_name(), "WGS 84 / UTM zone 18N");
  EXPECT_THAT(Refusal({.user = "EPSG:99", .projected = 26917}), HasSubstr("--crs: 'EPSG:99' cannot be used"));
  EXPECT_THAT(Refusal({.user = "nonsense"}), HasSubstr("--crs: 'nonsense' cannot be used"));
  EXPECT_THAT(Refusal({.user = "EPSG:5703"}), HasSubstr("not a projected or geographic"));
}

TEST(MapFrame, AsksForACoordinateSystemWhereNoneIsStated) {
  EXPECT_THAT(Refusal({}),
              HasSubstr("in.las: its coordinate system cannot be used (it states none); name it by --crs"));
}

TEST(MapFrame, HasNoPositionWhereTheProjectionIsNotDefined) {
  EXPECT_FALSE(std::isfinite(UserFrame("EPSG:2154")->Project(At(-90, 3)).x));
}

// The inverse of Project. Both are right to 1e-12 rad at least: PROJ's series and iterations stop there, and a
// coordinate of 1e7 units is rounded to 2e-9 units, 3e-16 rad.
TEST(MapFrame, FindsTheWayBackFromTheMap) {
  for (const char* crs : {"EPSG:32617", "EPSG:26917", "EPSG:2236", "EPSG:4269"}) {
    const auto frame = UserFrame(crs);
    for (const GeographicPosition& position : {At(26, -81.8), At(25.1, -80.4), At(30.5, -84)}) {
      const std::optional<GeographicPosition> back = frame->GeographicAt(frame->Project(position));
      ASSERT_TRUE(back.has_value()) << crs;
      EXPECT_NEAR(back->latitude, position.latitude, 2e-12) << crs;
      EXPECT_NEAR(back->longitude, position.longitude, 2e-12) << crs;
    }
  }
}

TEST(MapFrame, FindsTheWayBackFromFeetThatGeoKeysState) {
  const auto frame = Frame({.projected = 26917, .linear_unit = 9003});
  const MapPosition metres = UserFrame("EPSG:26917")->Project(At(26, -81.8));
  const std::optional<GeographicPosition> back = frame->GeographicAt({metres.x / kUsFoot, metres.y / kUsFoot});
  ASSERT_TRUE(back.has_value());
  EXPECT_NEAR(back->latitude, 26 * kDegree, 2e-12);
  EXPECT_NEAR(back->longitude, -81.8 * kDegree, 2e-12);
}

TEST(MapFrame, CountsLongitudesFromGreenwichWhereTheMapDoesNot) {
  const auto frame = UserFrame("EPSG:27572");  // NTF (Paris) / Lambert zone II, in grads from Paris.
  const GeographicPosition position = At(47, 1.5);
  const std::optional<GeographicPosition> back = frame->GeographicAt(frame->Project(position));
  ASSERT_TRUE(back.has_value());
  EXPECT_NEAR(back->latitude, position.latitude, 2e-12);
  EXPECT_NEAR(back->longitude, position.longitude, 2e-12);
}

TEST(MapFrame, HasNoWayBackFromOutsideOfTheMap) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const char* crs : {"EPSG:32617", "EPSG:2236", "EPSG:2154", "EPSG:4269"}) {
    const auto frame = UserFrame(crs);
    for (const double far : {1e12, 1e300, infinity, std::nan("")})
      EXPECT_FALSE(frame->GeographicAt({500000, far}).has_value()) << crs << " " << far;
  }
  EXPECT_FALSE(UserFrame("EPSG:4269")->GeographicAt({-81.5, 91}).has_value());
  // A point that was refused leaves nothing behind.
  const auto frame = UserFrame("EPSG:32617");
  EXPECT_FALSE(frame->GeographicAt({infinity, 0}).has_value());
  EXPECT_TRUE(frame->GeographicAt({500000, 3e6}).has_value());
}

TEST(MapFrame, GivesTheSameNumbersToEveryThread) {
  const auto frame = UserFrame("EPSG:26917");
  std::vector<std::thread> threads;
  std::array<MapPosition, 8> results;
  for (MapPosition& result : results) {
    threads.emplace_back([&] {
      for (int i = 0; i < 1000; ++i) result = frame->Project(At(26, -82 + 0.001 * i));
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const MapPosition& result : results) EXPECT_EQ(result.x, results[0].x);
}

TEST(MapFrame, NamesTheMissingDatabase) {
  setenv("PROJ_LIB", "/nonexistent", 1);
  const std::string refusal = Refusal({.user = "EPSG:26917"});
  unsetenv("PROJ_LIB");
  EXPECT_THAT(refusal, HasSubstr("PROJ does not find proj.db"));
}

}  // namespace
}  // namespace albtpu::formats
