#include "tests/formats/laz/busy_points.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <set>
#include <string>

namespace albtpu::testing {
namespace {

template <typename Number>
Number At(const std::string& records, std::size_t offset) {
  Number number;
  std::memcpy(&number, records.data() + offset, sizeof number);
  return number;
}

TEST(BusyPoints, UseEachChannelReturnFlagAndManyClasses) {
  const RecordLayout layout{6, 0};
  const std::string records = BusyRecords(layout, 20000);
  std::set<int> channels, returns, flags, classes;
  bool backwards = false, negative = false, positive = false;
  std::array<double, 4> last_time{};
  for (std::size_t at = 0; at < records.size(); at += RecordLength(layout)) {
    const auto bits = At<std::uint8_t>(records, at + 15);
    const int channel = bits >> 4 & 3;
    channels.insert(channel);
    flags.insert(bits & 15);
    returns.insert(At<std::uint8_t>(records, at + 14));
    classes.insert(At<std::uint8_t>(records, at + 16));
    const auto angle = At<std::int16_t>(records, at + 18);
    negative |= angle < 0;
    positive |= angle > 0;
    const auto time = At<double>(records, at + 22);
    backwards |= time < last_time[channel];
    last_time[channel] = time;
  }
  EXPECT_EQ(channels.size(), 4u);
  EXPECT_EQ(flags.size(), 16u);
  EXPECT_GT(returns.size(), 100u);
  EXPECT_GT(classes.size(), 100u);
  EXPECT_TRUE(backwards && negative && positive);
}

}  // namespace
}  // namespace albtpu::testing
