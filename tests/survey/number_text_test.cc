#include "survey/number_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace albtpu::client {
namespace {

TEST(NumberText, ReadsDecimalNumbersOfAnyCommonForm) {
  EXPECT_EQ(ParseFloat("12.5"), 12.5f);
  EXPECT_EQ(ParseFloat(" -3 "), -3.0f);
  EXPECT_EQ(ParseFloat("+1e3"), 1000.0f);
  EXPECT_EQ(ParseFloat(".5"), 0.5f);
  EXPECT_EQ(ParseFloat("inf"), std::numeric_limits<float>::infinity());
  EXPECT_EQ(ParseFloat("-Infinity"), -std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(ParseFloat("NaN").value()));
}

TEST(NumberText, RefusesWhatIsNoNumber) {
  for (const char* text : {"", " ", "deep", "1,5", "1.5 m", "1e", "--1", "12_000", "0x10"}) {
    EXPECT_FALSE(ParseFloat(text).has_value()) << text;
    EXPECT_FALSE(ParseDouble(text).has_value()) << text;
  }
}

TEST(NumberText, RoundsOnceToSinglePrecision) {
  // Just above the middle between 1 and the next float32; by way of a double it would fall on the middle and
  // become 1.
  EXPECT_EQ(ParseFloat("1.00000005960464477540"), std::nextafter(1.0f, 2.0f));
}

TEST(NumberText, TakesNoFiniteNumberForInfinity) {
  EXPECT_EQ(ParseFloat("1e39"), std::numeric_limits<float>::max());
  EXPECT_EQ(ParseFloat("-1e999"), std::numeric_limits<float>::lowest());
  EXPECT_EQ(ParseFloat("1e-99"), 0.0f);
}

TEST(NumberText, WritesNineDigits) {
  EXPECT_EQ(FormatFloat(0.3f), "0.300000012");
  EXPECT_EQ(FormatFloat(2), "2");
  EXPECT_EQ(FormatFloat(-1), "-1");
}

TEST(NumberText, ReadsBackEveryFloat) {
  // Every 9973rd of all finite float32.
  for (std::uint32_t bits = 0; bits < 0x7F800000u; bits += 9973) {
    float value;
    std::memcpy(&value, &bits, sizeof value);
    ASSERT_EQ(ParseFloat(FormatFloat(value)), value) << FormatFloat(value);
  }
}

}  // namespace
}  // namespace albtpu::client
