#include "formats/las/las_contents.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "tests/formats/las/las_builder.h"
#include "tests/temporary_folder.h"

namespace albtpu::formats {
namespace {

using albtpu::testing::LasPoint;
using albtpu::testing::LasSpec;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

LasContents ContentsOf(const LasSpec& spec) {
  albtpu::testing::TemporaryFolder folder;
  const absl::StatusOr<LasReader> reader = LasReader::Open(folder.Write("in.las", BuildLas(spec)));
  EXPECT_TRUE(reader.ok()) << reader.status();
  const absl::StatusOr<LasContents> contents = ReadContents(*reader);
  EXPECT_TRUE(contents.ok()) << contents.status();
  return *contents;
}

// Points whose scan angles are `angle(i)` degrees.
template <typename Angle>
ScanPattern PatternOf(const Angle& angle, std::size_t points = 5000) {
  LasSpec spec;
  for (std::size_t i = 0; i < points; ++i) spec.points.push_back({.scan_angle = angle(static_cast<double>(i))});
  return ContentsOf(spec).scan_pattern();
}

TEST(LasContents, AreCountedByClassWithHeightsTimesAndReturns) {
  for (const int format : {1, 6}) {
    LasSpec spec;
    spec.point_format = format;
    spec.scale = 0.5;
    spec.points = {
        {.z = -20, .classification = 26, .scan_angle = -12, .gps_time = 7},
        {.z = -10, .classification = 26, .scan_angle = 9, .gps_time = 9, .return_number = 2, .return_count = 3},
        {.z = 4, .classification = 9, .gps_time = 5}};
    const LasContents contents = ContentsOf(spec);
    EXPECT_EQ(contents.points, 3u);
    EXPECT_THAT(contents.ClassesWithPoints(), ElementsAre(9, 26));
    EXPECT_THAT(contents.Of(UsualSurfaceClasses(1)), ElementsAre(9));
    EXPECT_THAT(contents.Of({40}), IsEmpty());
    EXPECT_EQ(contents.classes[26].points, 2u);
    EXPECT_EQ(contents.classes[26].lowest, -10);
    EXPECT_EQ(contents.classes[26].highest, -5);
    EXPECT_EQ(contents.classes[26].mean_height(), -7.5);
    EXPECT_EQ(contents.first_time, 5);
    EXPECT_EQ(contents.last_time, 9);
    EXPECT_TRUE(contents.has_times());
    EXPECT_EQ(contents.most_returns, 3);
    EXPECT_EQ(contents.of_several, 1u);
    EXPECT_EQ(contents.least_angle, -12);
    EXPECT_EQ(contents.greatest_angle, 9);
  }
}

TEST(LasContents, HaveNoTimesWhereFormatOrSoftwareHasNone) {
  LasSpec spec;
  spec.points.resize(3);
  EXPECT_FALSE(ContentsOf(spec).has_times());  // All 0.
  for (LasPoint& point : spec.points) point.gps_time = std::nan("");
  EXPECT_FALSE(ContentsOf(spec).has_times());
  spec.points = {{.gps_time = 1}, {.gps_time = 2}};
  spec.point_format = 2;
  spec.version_minor = 2;
  EXPECT_FALSE(ContentsOf(spec).has_times());
  EXPECT_FALSE(ContentsOf(LasSpec()).has_times());  // No points.
}

TEST(LasContents, CountPairsOfReturnsUnderWater) {
  const auto pairs = [](const LasPoint& upper, const LasPoint& lower) {
    LasSpec spec;
    spec.scale = 1;
    spec.points = {upper, lower, {.z = 9, .classification = 41, .gps_time = 2}};
    return ContentsOf(spec).pairs;
  };
  const LasPoint upper = {.z = -3, .classification = 45, .gps_time = 1, .return_number = 1, .return_count = 2};
  const LasPoint lower = {.z = -5, .classification = 40, .gps_time = 1, .return_number = 2, .return_count = 2};
  EXPECT_EQ(pairs(upper, lower), 1u);
  LasPoint other = upper;
  other.classification = 41;  // The surface.
  EXPECT_EQ(pairs(other, lower), 0u);
  other = upper, other.gps_time = 0;
  EXPECT_EQ(pairs(other, lower), 0u);
  other = upper, other.z = lower.z;
  EXPECT_EQ(pairs(other, lower), 0u);
  other = lower, other.classification = 2;  // Land.
  EXPECT_EQ(pairs(upper, other), 0u);
}

TEST(LasContents, TellThePatternOfTheScanner) {
  const auto circle = [](double i) { return 20 * std::sin(0.1 * i); };
  EXPECT_EQ(PatternOf(circle), ScanPattern::kPalmer);
  EXPECT_EQ(PatternOf([](double i) { return std::fmod(i, 41) - 20; }), ScanPattern::kRaster);
  EXPECT_EQ(PatternOf(circle, 900), ScanPattern::kUnknown);
  EXPECT_EQ(PatternOf([](double) { return 15.0; }), ScanPattern::kUnknown);
  EXPECT_EQ(PatternOf([](double) { return 0.0; }), ScanPattern::kUnknown);
}

TEST(LasContents, NameSystemsOfHeights) {
  EXPECT_EQ(VerticalNameOf({}), "");
  EXPECT_EQ(VerticalNameOf({.vertical = 5703}), "EPSG:5703");
  EXPECT_EQ(VerticalNameOf({.wkt = "COMPD_CS[\"a + b\",PROJCS[\"a\"],VERT_CS[\"NAVD88 height\",VERT_DATUM[\"x\"]]]"}),
            "NAVD88 height");
  EXPECT_EQ(VerticalNameOf({.wkt = "COMPOUNDCRS[\"a + b\",VERTCRS[\"DHHN2016 height\",VDATUM[\"x\"]]]"}),
            "DHHN2016 height");
}

}  // namespace
}  // namespace albtpu::formats
