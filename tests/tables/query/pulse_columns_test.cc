#include "tables/query/pulse_columns.h"

#include <gmock/gmock.h>

#include <limits>
#include <string>
#include <vector>

#include "tables/schema.h"
#include "tables/water/water_schema.h"

namespace albtpu {
namespace {

using ::testing::HasSubstr;

const std::vector<float> kOne = {5}, kThree = {1, 2, 3};

TEST(PulseColumns, HaveOneNumberForEachPulseOrOneForAllOrNone) {
  const PulseColumns pulses{.size = 3, .axis = {kOne, {}, kThree, {}, kOne, kThree}};
  EXPECT_TRUE(CheckLengths(pulses).ok());
  const Pulse second = PulseAt(pulses, 1);
  EXPECT_EQ(second.wind_speed, 5);
  EXPECT_EQ(second.fetch, std::numeric_limits<float>::infinity());
  EXPECT_EQ(second.incidence, 2);
  EXPECT_FALSE(second.azimuth.has_value());
  EXPECT_EQ(second.footprint, 5);
  EXPECT_EQ(second.depth, 2);
  EXPECT_EQ(PulseAt({.size = 3, .axis = {kOne, kOne, kOne, kThree, kOne, kOne}}, 2).azimuth, 3);
}

TEST(PulseColumns, OfWrongLengthAreNamed) {
  for (const std::size_t size : {2, 4}) {
    const absl::Status status = CheckLengths({.size = size, .axis = {kOne, {}, kThree, {}, kOne, kThree}});
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
    EXPECT_THAT(std::string(status.message()), HasSubstr("'incidence' has 3 numbers"));
  }
}

TEST(PulseColumns, MayAllBeEmptyIfThereAreNoPulses) { EXPECT_TRUE(CheckLengths({}).ok()); }

TEST(PulseColumns, MayLackOnlyWhatTheSchemaAllows) {
  for (const TableSchema& schema : {kSeaSurface, kOneSea, kWaterColumn}) {
    for (std::size_t absent = 0; absent < schema.axes.size(); ++absent) {
      PulseColumns pulses{.size = 3, .axis = {kOne, kOne, kThree, kThree, kOne, kThree}};
      pulses.axis[absent] = {};
      EXPECT_EQ(CheckLengths(schema, pulses).ok(), schema.axes[absent].if_absent != IfAbsent::kRefuse)
          << schema.name << " without " << schema.axes[absent].name;
    }
  }
}

}  // namespace
}  // namespace albtpu
