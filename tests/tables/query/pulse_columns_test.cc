#include "tables/query/pulse_columns.h"

#include <gmock/gmock.h>

#include <limits>
#include <string>
#include <vector>

#include "tests/tables/query/table_kinds.h"

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

TEST(PulseColumns, MayLackOnlyFetchAndAzimuth) {
  for (AxisId absent : kAxes) {
    PulseColumns pulses{.size = 3, .axis = {kOne, kOne, kThree, kThree, kOne, kThree}};
    pulses.axis[Index(absent)] = {};
    EXPECT_EQ(CheckLengths(pulses).ok(), absent == AxisId::kFetch || absent == AxisId::kAzimuth);
  }
}

TEST(PulseColumns, OfAnotherKindMayLackOnlyWhatTheSchemaAllows) {
  const TableSchema& schema = testing::kThreeAxes;
  for (std::size_t absent = 0; absent < schema.axes.size(); ++absent) {
    PulseColumns pulses{.size = 3, .axis = {kThree, kThree, kThree}};
    pulses.axis[absent] = {};
    EXPECT_EQ(CheckLengths(schema, pulses).ok(), absent != 2);
  }
}

}  // namespace
}  // namespace albtpu
