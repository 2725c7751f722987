#include "sea/sea_time.h"

#include <gtest/gtest.h>

#include <cmath>

namespace albtpu {
namespace {

TEST(SecondsOf, CountsFrom1970) {
  EXPECT_EQ(SecondsOf({.year = 1970, .month = 1, .day = 1}), 0);
  EXPECT_EQ(SecondsOf({.year = 2000, .month = 3, .day = 1}), 951868800);  // date -u -d 2000-03-01 +%s
  EXPECT_EQ(SecondsOf({.year = 2020, .month = 6, .day = 8, .hour = 3, .minute = 50}), 1591588200);
  EXPECT_EQ(SecondsOf({.year = 1996, .month = 2, .day = 29, .hour = 23}), 825634800);
  EXPECT_EQ(SecondsOf({.year = 1900, .month = 3, .day = 1}), -2203891200);
}

TEST(SecondsOf, RefusesWhatIsNoTime) {
  EXPECT_FALSE(SecondsOf({.year = 2019, .month = 2, .day = 29}));
  EXPECT_FALSE(SecondsOf({.year = 1900, .month = 2, .day = 29}));
  EXPECT_FALSE(SecondsOf({.year = 1899, .month = 12, .day = 31}));
  EXPECT_FALSE(SecondsOf({.year = 2201, .month = 1, .day = 1}));
  EXPECT_FALSE(SecondsOf({.year = 2020, .month = 13, .day = 1}));
  EXPECT_FALSE(SecondsOf({.year = 2020, .month = 0, .day = 1}));
  // std::chrono keeps months and days in 8 bits.
  EXPECT_FALSE(SecondsOf({.year = 2020, .month = 257, .day = 1}));
  EXPECT_FALSE(SecondsOf({.year = 2020, .month = 1, .day = 257}));
  EXPECT_FALSE(SecondsOf({.year = 2020, .month = 1, .day = 1, .hour = 24}));
  EXPECT_FALSE(SecondsOf({.year = 2020, .month = 1, .day = 1, .minute = -1}));
}

TEST(SeaTime, IsSecondsOfUtcSince1970) {
  EXPECT_EQ(ParseSeaTime("1970-01-01T00:00Z"), 0);
  EXPECT_EQ(ParseSeaTime("2020-06-08T03:50Z"), 1591588200);
  EXPECT_EQ(ParseSeaTime("2020-06-08T03:50:07Z"), 1591588207);
  EXPECT_EQ(ParseSeaTime("1969-12-31T23:59:59Z"), -1);
}

TEST(SeaTime, IsNoOtherText) {
  for (const char* text :
       {"", "2020-06-08", "2020-06-08T03:50", "2020-06-08 03:50Z", "2020-06-08T03:50+0", "2020-06-31T03:50Z",
        "2020-06-08T24:00Z", "2020-06-08T03:50:60Z", "20200608T035000Z", "x020-06-08T03:50Z", "2020-06-08T03:50:7.5Z"})
    EXPECT_FALSE(ParseSeaTime(text)) << text;
}

TEST(SeaTimeText, IsReadBack) {
  EXPECT_EQ(SeaTimeText(1591588200), "2020-06-08T03:50Z");
  EXPECT_EQ(SeaTimeText(1591588207), "2020-06-08T03:50:07Z");
  for (double time = -2.2e9; time < 7e9; time += 1e8 / 7) EXPECT_EQ(ParseSeaTime(SeaTimeText(time)), std::round(time));
}

}  // namespace
}  // namespace albtpu
