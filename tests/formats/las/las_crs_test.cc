#include "formats/las/las_crs.h"

#include <gmock/gmock.h>

#include "formats/las/wkt_records.h"
#include "tests/formats/las/las_builder.h"
#include "tests/temporary_folder.h"

namespace albtpu::formats {
namespace {

using albtpu::testing::GeoKeys;

TEST(LasCrs, FindsFeetInWellKnownText) {
  for (const char* wkt : {
           "PROJCS[\"x\",UNIT[\"US survey foot\",0.3048006096012192,AUTHORITY[\"EPSG\",\"9003\"]]]",
           "PROJCS[\"x\",UNIT[\"metre\",1]],VERT_CS[\"NAVD88 height "
           "(ftUS)\",UNIT[\"Foot_US\",0.304800609601219]]",
           "PROJCRS[\"x\",LENGTHUNIT[\"foot\",0.3048]]",
           "PROJCS[\"x\",UNIT (\"some name\", 0.3048)]",
           "VERT_CS[\"x\",UNIT[\"ft\"]]",
           "VERT_CS[\"x\",Unit[\"British feet\",0.30480061]]",
       })
    EXPECT_TRUE(FindFeetInWkt(wkt).has_value()) << wkt;
}

TEST(LasCrs, SearchesALongTextQuickly) {
  std::string wkt;
  while (wkt.size() < 1'000'000) wkt += "UNIT[";
  EXPECT_FALSE(FindFeetInWkt(wkt + "\"metre\",1]").has_value());
}

TEST(LasCrs, FindsNoFeetInMetres) {
  for (const char* wkt : {albtpu::testing::kMetricWkt, "", "UNIT[\"degree\",0.0174532925199433]", "UNIT[\"metre",
                          "UNIT[", "UNITED STATES FOOT", "LENGTHUNIT[\"kilometre\",1000]"})
    EXPECT_FALSE(FindFeetInWkt(wkt).has_value()) << wkt;
}

TEST(LasCrs, FindsFeetInGeoKeys) {
  EXPECT_EQ(FindFeetInGeoKeys(GeoKeys({{1024, 1}, {3076, 9003}})), "GeoTIFF key 3076 = 9003");
  EXPECT_EQ(FindFeetInGeoKeys(GeoKeys({{3076, 9001}, {4099, 9002}})), "GeoTIFF key 4099 = 9002");
  EXPECT_FALSE(FindFeetInGeoKeys(GeoKeys({{3076, 9001}, {4099, 9001}, {3072, 9002}})).has_value());
  EXPECT_FALSE(FindFeetInGeoKeys("").has_value());
  EXPECT_FALSE(FindFeetInGeoKeys("short").has_value());
}

TEST(LasCrs, SearchesVlrsAndEvlrs) {
  const albtpu::testing::TemporaryFolder folder;
  const albtpu::testing::LasRecord in_feet = {"LASF_Projection", 2112, "X[UNIT[\"foot\",0.3048]]"};
  albtpu::testing::LasSpec spec;
  spec.points.resize(1);
  const auto finds_feet = [&] {
    return FindFeet(*LasReader::Open(folder.Write("in.las", BuildLas(spec)))).value().has_value();
  };
  EXPECT_FALSE(finds_feet());
  spec.vlrs.push_back({"somebody else", 2112, in_feet.data});
  EXPECT_FALSE(finds_feet());
  spec.evlrs.push_back(in_feet);
  EXPECT_TRUE(finds_feet());
  spec.evlrs.clear();
  spec.vlrs.push_back({"LASF_Projection", 34735, GeoKeys({{4099, 9002}})});
  EXPECT_TRUE(finds_feet());
}

TEST(LasCrs, DescribesGeoKeys) {
  const CrsDescription description =
      DescribeGeoKeys(GeoKeys({{1024, 1}, {3072, 26917}, {2048, 4269}, {3076, 9003}, {4096, 5703}, {4099, 9001}}));
  EXPECT_EQ(description.projected, 26917);
  EXPECT_EQ(description.geographic, 4269);
  EXPECT_EQ(description.linear_unit, 9003);
  EXPECT_EQ(description.vertical, 5703);
  EXPECT_EQ(description.vertical_unit, 9001);
  EXPECT_TRUE(DescribeGeoKeys(GeoKeys({{1024, 1}, {3072, 32767}, {2048, 0}})).empty());
  EXPECT_TRUE(DescribeGeoKeys("").empty());
}

TEST(LasCrs, DescribesWhatTheRecordsState) {
  const albtpu::testing::TemporaryFolder folder;
  albtpu::testing::LasSpec spec;
  spec.points.resize(1);
  const auto describe = [&] { return DescribeCrs(*LasReader::Open(folder.Write("in.las", BuildLas(spec)))).value(); };
  EXPECT_TRUE(describe().empty());
  const std::string wkt = albtpu::testing::kMetricWkt;
  spec.vlrs.push_back({"LASF_Projection", 2112, wkt + std::string(3, '\0')});
  spec.evlrs.push_back({"LASF_Projection", 34735, GeoKeys({{3072, 26917}})});
  spec.evlrs.push_back({"LASF_Projection", 2112, "another"});
  EXPECT_EQ(describe().wkt, wkt);
  EXPECT_EQ(describe().projected, 26917);
  EXPECT_TRUE(describe().user.empty());
}

// kMetricWkt is UTM zone 17N, EPSG:32617, in metres.
struct TwoRecords {
  bool wkt_counts;
  std::vector<std::pair<int, int>> keys;
  double unit, height_unit;  // m; 0: not stated.
  bool remarked;
};

TEST(LasCrs, TakesTheRecordThatTheHeaderNamesAndRemarksContradictions) {
  constexpr double kSurveyFoot = 1200.0 / 3937;
  const TwoRecords cases[] = {
      {true, {{3072, 32617}}, 1, 0, false},                            // The same.
      {true, {{3072, 32617}, {4099, 9003}}, 1, kSurveyFoot, false},    // The keys add a unit of heights.
      {true, {{3072, 2236}, {3076, 9003}, {4099, 9003}}, 1, 0, true},  // Left over from a map in feet.
      {true, {{3072, 32618}, {4099, 9003}}, 1, 0, true},               // Another zone.
      {true, {{2048, 4326}, {3072, 32767}}, 1, 0, false},              // A projection of the user's own.
      {false, {{3072, 32617}, {4099, 9001}}, 1, 1, false},
      {false, {{3072, 32618}, {4099, 9003}}, 1, kSurveyFoot, true},  // The keys count.
  };
  const albtpu::testing::TemporaryFolder folder;
  for (const TwoRecords& each : cases) {
    albtpu::testing::LasSpec spec;
    spec.points.resize(1);
    spec.point_format = each.wkt_counts ? 6 : 1;
    spec.vlrs = {{"LASF_Projection", 2112, albtpu::testing::kMetricWkt},
                 {"LASF_Projection", 34735, GeoKeys(each.keys)}};
    const absl::StatusOr<LasReader> reader = LasReader::Open(folder.Write("in.las", BuildLas(spec)));
    const absl::StatusOr<LasCrs> crs = CrsOf(*reader, "", {450000, 3000000});
    ASSERT_TRUE(crs.ok()) << crs.status();
    const std::string which = absl::StrCat(each.keys[0].second, ", text counts: ", each.wkt_counts);
    EXPECT_EQ(crs->map->unit(), each.unit) << which;
    EXPECT_NEAR(crs->metres_per_height_unit.value_or(0), each.height_unit, 1e-9) << which;
    EXPECT_EQ(crs->remark.empty(), !each.remarked) << which << crs->remark;
  }
}

// Longitudes from 0 to 360, of which PROJ makes -180 to 180.
TEST(LasCrs, FindsNoContradictionInLongitudesTo360) {
  const auto map = *MapFrame::Create("in.las", {.user = "EPSG:4326"});
  for (const double x : {-160., 179., 200.}) EXPECT_LT(Apart(*map, *map, {x, -16.8}), 1e-6) << x;
  const albtpu::testing::TemporaryFolder folder;
  albtpu::testing::LasSpec spec;
  spec.points.resize(1);
  spec.vlrs = {{"LASF_Projection", 2112, map->wkt()},
               {"LASF_Projection", 34735, GeoKeys({{2048, 4326}, {4099, 9003}})}};
  const absl::StatusOr<LasReader> reader = LasReader::Open(folder.Write("in.las", BuildLas(spec)));
  const absl::StatusOr<LasCrs> crs = CrsOf(*reader, "", {200, -16.8});
  ASSERT_TRUE(crs.ok()) << crs.status();
  EXPECT_DOUBLE_EQ(crs->metres_per_height_unit.value_or(0), 1200.0 / 3937);
  EXPECT_EQ(crs->remark, "");
}

std::string WithReplaced(std::string text, const std::string& what, const std::string& by) {
  text.replace(text.find(what), what.size(), by);
  return text;
}

TEST(LasCrs, RefusesTextsThatContradictEachOther) {
  const std::string metric = albtpu::testing::kMetricWkt;
  const std::string vertical =
      ",VERT_CS[\"NAVD88 height\",VERT_DATUM[\"North American Vertical Datum 1988\",2005],UNIT["
      "\"metre\",1]]]";
  const std::string compound = "COMPD_CS[\"both\"," + metric + vertical;
  const struct {
    std::string first, second, said;  // Refused if it begins with "(".
  } kCases[] = {
      {metric, metric, ""},
      {metric, WithReplaced(metric, "UNIT[\"metre\",1]", "UNIT[\"foot\",0.3048]"),
       "(unit of x and y, 1 m and 0.3048 m"},
      {metric,
       WithReplaced(WithReplaced(metric, "DATUM[\"WGS_1984\"", "DATUM[\"North_American_Datum_1983\""),
                    "84\",6378137,298.257223563", "84\",6378137,298.257222101"),
       "(datum, WGS_1984 and North_American_Datum_1983"},
      {metric, WithReplaced(metric, "-81", "-75"), "(projection, WGS 84 / UTM zone 17N and"},
      {compound, WithReplaced(compound, "UNIT[\"metre\",1]]]", "UNIT[\"foot\",0.3048]]]"),
       "(unit of heights, 1 m and 0.3048 m"},
      {metric, compound, "has 2 records of well-known text, which agree; the first is used"},
      {metric, "nonsense", "has 2 records of well-known text, of which the first is used"},
  };
  const albtpu::testing::TemporaryFolder folder;
  for (const auto& [first, second, said] : kCases) {
    for (const bool evlr : {false, true}) {
      albtpu::testing::LasSpec spec;
      spec.points.resize(1);
      spec.point_format = 6;
      spec.vlrs = {{"LASF_Projection", 2112, first}};
      (evlr ? spec.evlrs : spec.vlrs).push_back({"LASF_Projection", 2112, second});
      const absl::StatusOr<LasReader> reader = LasReader::Open(folder.Write("in.las", BuildLas(spec)));
      ASSERT_TRUE(reader.ok()) << reader.status();
      const absl::StatusOr<LasCrs> crs = CrsOf(*reader, "", {450000, 3000000});
      if (said.starts_with('(')) {
        EXPECT_THAT(std::string(crs.status().message()), ::testing::HasSubstr(said));
        EXPECT_TRUE(CrsOf(*reader, "EPSG:32617", {450000, 3000000}).ok());
      } else {
        ASSERT_TRUE(crs.ok()) << crs.status();
        EXPECT_EQ(crs->remark.empty(), said.empty()) << crs->remark;
        EXPECT_THAT(crs->remark, ::testing::HasSubstr(said));
      }
    }
  }
}

}  // namespace
}  // namespace albtpu::formats
