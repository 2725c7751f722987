#include "tables/pulse_columns.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace albtpu {
namespace {

const std::vector<float> kOne = {5}, kThree = {1, 2, 3};

TEST(PulseColumns, HaveALengthOrOneNumberOrNone) {
  const PulseColumns pulses{.size = 3, .axis = {kOne, {}, kThree, {}, kOne, kThree}};
  EXPECT_TRUE(IsValid(pulses));
  const Pulse second = PulseAt(pulses, 1);
  EXPECT_EQ(second.wind_speed, 5);
  EXPECT_EQ(second.fetch, std::numeric_limits<float>::infinity());
  EXPECT_EQ(second.incidence, 2);
  EXPECT_FALSE(second.azimuth.has_value());
  EXPECT_EQ(second.footprint, 5);
  EXPECT_EQ(second.depth, 2);
  EXPECT_EQ(PulseAt({.size = 3, .axis = {kOne, kOne, kOne, kThree, kOne, kOne}}, 2).azimuth, 3);
}

TEST(PulseColumns, OfOtherLengthsAreNotValid) {
  EXPECT_FALSE(IsValid({.size = 2, .axis = {kOne, {}, kThree, {}, kOne, kThree}}));
  EXPECT_FALSE(IsValid({.size = 4, .axis = {kOne, {}, kThree, {}, kOne, kThree}}));
}

TEST(PulseColumns, MayLackTheFetchAndTheAzimuthOnly) {
  for (AxisId absent : kAxes) {
    PulseColumns pulses{.size = 3, .axis = {kOne, kOne, kThree, kThree, kOne, kThree}};
    pulses.axis[Index(absent)] = {};
    EXPECT_EQ(IsValid(pulses), absent == AxisId::kFetch || absent == AxisId::kAzimuth);
  }
}

}  // namespace
}  // namespace albtpu
