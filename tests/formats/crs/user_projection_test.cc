#include "formats/crs/user_projection.h"

#include <gmock/gmock.h>

#include <cstring>
#include <numbers>

#include "formats/crs/map_frame.h"
#include "formats/las/las_crs.h"
#include "tests/degree.h"

namespace albtpu::formats {
namespace {

using ::testing::HasSubstr;

using albtpu::testing::kDegree;

// Entries with values in the record of real numbers where `real` is set.
struct Entry {
  std::uint16_t key, value;
  std::optional<double> real = std::nullopt;
};

struct Records {
  std::string directory, reals;
};

Records RecordsOf(const std::vector<Entry>& entries) {
  Records records;
  const auto add = [&](std::uint16_t number) { records.directory.append(reinterpret_cast<const char*>(&number), 2); };
  for (const std::uint16_t number :
       {std::uint16_t{1}, std::uint16_t{1}, std::uint16_t{0}, static_cast<std::uint16_t>(entries.size())})
    add(number);
  for (const Entry& entry : entries) {
    add(entry.key);
    add(entry.real.has_value() ? 34736 : 0);
    add(1);
    add(entry.real.has_value() ? static_cast<std::uint16_t>(records.reals.size() / 8) : entry.value);
    if (entry.real.has_value()) records.reals.append(reinterpret_cast<const char*>(&*entry.real), 8);
  }
  return records;
}

CrsDescription Describe(const std::vector<Entry>& entries) {
  const Records records = RecordsOf(entries);
  return DescribeGeoKeys(records.directory, records.reals);
}

absl::StatusOr<std::shared_ptr<const MapFrame>> FrameOf(const std::vector<Entry>& entries) {
  return MapFrame::Create("in.las", Describe(entries));
}

void ExpectSame(const MapFrame& own, const char* code, double latitude, double longitude) {
  const auto known = MapFrame::Create("in.las", {.user = code});
  const GeographicPosition position = {latitude * kDegree, longitude * kDegree};
  const MapPosition expected = (*known)->Project(position), found = own.Project(position);
  EXPECT_NEAR(found.x, expected.x, 1e-6) << code;
  EXPECT_NEAR(found.y, expected.y, 1e-6) << code;
  EXPECT_EQ(own.unit(), (*known)->unit());
  EXPECT_TRUE(own.is_transverse_mercator());
}

// As the software of a scanner of snow wrote them: nothing but the zone and the ellipsoid has a code or a number.
const std::vector<Entry> kZoneOnEllipsoid = {{1024, 1},
                                             {2048, 32767},
                                             {2050, 32767},
                                             {2054, 9102},
                                             {2056, 32767},
                                             {2057, 0, 6378137.0},
                                             {2059, 0, 298.257223563},
                                             {2061, 0, 0.0},
                                             {3072, 32767},
                                             {3074, 16011},
                                             {3076, 9001},
                                             {4099, 9001}};

TEST(UserProjection, IsAZoneOfUtm) {
  const auto north = FrameOf(kZoneOnEllipsoid);
  ASSERT_TRUE(north.ok()) << north.status();
  ExpectSame(**north, "EPSG:32611", 38.2, -118.5);
  EXPECT_EQ((*north)->crs_name(), "UTM zone 11N");
  EXPECT_EQ((*north)->metres_per_height_unit(), 1);
  const auto south = FrameOf({{2048, 4283}, {3072, 32767}, {3074, 16155}, {3076, 9001}});
  ExpectSame(**south, "EPSG:28355", -37.5, 146);
  const auto by_ellipsoid = FrameOf({{2048, 32767}, {2056, 7019}, {3072, 32767}, {3074, 16017}});
  ExpectSame(**by_ellipsoid, "EPSG:26917", 26, -82);
}

TEST(UserProjection, IsATransverseMercatorWithAllParameters) {
  const std::vector<Entry> utm = {{2048, 4269},   {3072, 32767},    {3074, 32767},  {3075, 1},
                                  {3076, 9001},   {3080, 0, -81.0}, {3081, 0, 0.0}, {3082, 0, 500000.0},
                                  {3083, 0, 0.0}, {3092, 0, 0.9996}};
  const auto frame = FrameOf(utm);
  ASSERT_TRUE(frame.ok()) << frame.status();
  ExpectSame(**frame, "EPSG:26917", 26, -82);
  // False eastings are in the unit of the map.
  std::vector<Entry> feet = utm;
  feet[4] = {3076, 9003};
  feet[7] = {3082, 0, 500000 * 3937 / 1200.0};
  const auto in_feet = FrameOf(feet);
  const GeographicPosition position = {26 * kDegree, -82 * kDegree};
  EXPECT_NEAR((*in_feet)->Project(position).x, (*frame)->Project(position).x * 3937 / 1200, 1e-5);
  EXPECT_NEAR((*in_feet)->unit(), 1200 / 3937.0, 1e-12);
  // Without one of them, it is not guessed.
  for (const std::uint16_t key : {3080, 3081, 3082, 3083, 3092, 3075}) {
    std::vector<Entry> less = utm;
    std::erase_if(less, [&](const Entry& entry) { return entry.key == key; });
    EXPECT_FALSE(Describe(less).own.has_projection()) << key;
  }
}

TEST(UserProjection, NeedsAnEllipsoidAndDegrees) {
  const auto error = [](const std::vector<Entry>& entries) { return std::string(FrameOf(entries).status().message()); };
  EXPECT_THAT(error({{2048, 32767}, {3072, 32767}, {3074, 16011}}), HasSubstr("an ellipsoid that is not stated"));
  EXPECT_THAT(error({{2056, 7}, {3072, 32767}, {3074, 16011}}), HasSubstr("an ellipsoid that is not stated, or not"));
  EXPECT_THAT(error({{2057, 0, 1.0}, {2059, 0, 298.0}, {3072, 32767}, {3074, 16011}}), HasSubstr("ellipsoid"));
  EXPECT_FALSE(Describe({{2048, 4326}, {2054, 9105}, {3074, 16011}}).own.has_projection());
  EXPECT_FALSE(Describe({{2048, 4326}, {3074, 16061}}).own.has_projection());
  EXPECT_FALSE(Describe({{2048, 4326}, {3074, 16100}}).own.has_projection());
}

TEST(UserProjection, GivesWayToACode) {
  EXPECT_FALSE(Describe({{2048, 4326}, {3072, 32611}, {3074, 16012}}).own.has_projection());
}

TEST(UserProjection, TakesNumbersFromTheirRecordAlone) {
  const Records records = RecordsOf(kZoneOnEllipsoid);
  for (const std::size_t size : {std::size_t{0}, std::size_t{7}, std::size_t{15}})
    EXPECT_FALSE(DescribeGeoKeys(records.directory, std::string_view(records.reals).substr(0, size))
                     .own.inverse_flattening.has_value());
}

}  // namespace
}  // namespace albtpu::formats
