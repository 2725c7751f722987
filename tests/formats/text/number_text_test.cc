#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "formats/text/text.h"

namespace albtpu::formats {
namespace {

TEST(NumberText, ReadsDecimalNumbersInAllCommonForms) {
  EXPECT_EQ(ParseFloat("12.5"), 12.5f);
  EXPECT_EQ(ParseFloat(" -3 "), -3.0f);
  EXPECT_EQ(ParseFloat("+1e3"), 1000.0f);
  EXPECT_EQ(ParseFloat(".5"), 0.5f);
  EXPECT_EQ(ParseFloat("inf"), std::numeric_limits<float>::infinity());
  EXPECT_EQ(ParseFloat("-Infinity"), -std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(ParseFloat("NaN").value()));
}

TEST(NumberText, RejectsTextThatIsNotANumber) {
  for (const char* text : {"", " ", "deep", "1,5", "1.5 m", "1e", "--1", "12_000", "0x10"}) {
    EXPECT_FALSE(ParseFloat(text).has_value()) << text;
    EXPECT_FALSE(ParseDouble(text).has_value()) << text;
  }
}

TEST(NumberText, RoundsOnceToSinglePrecision) {
  // Just above the midpoint between 1 and the next float32. Rounded to double first, it would fall on the midpoint and
  // then become 1.
  EXPECT_EQ(ParseFloat("1.00000005960464477540"), std::nextafter(1.0f, 2.0f));
}

TEST(NumberText, KeepsFiniteNumbersFinite) {
  EXPECT_EQ(ParseFloat("1e39"), std::numeric_limits<float>::max());
  EXPECT_EQ(ParseFloat("-1e999"), std::numeric_limits<float>::lowest());
  EXPECT_EQ(ParseFloat("1e-99"), 0.0f);
}

TEST(NumberText, WritesNineSignificantDigits) {
  EXPECT_EQ(FormatFloat(0.3f), "0.300000012");
  EXPECT_EQ(FormatFloat(2), "2");
  EXPECT_EQ(FormatFloat(-1), "-1");
}

TEST(NumberText, ReadsBackEveryFloat) {
  // Every 9973rd of the finite, non-negative float32.
  for (std::uint32_t bits = 0; bits < 0x7F800000u; bits += 9973) {
    float value;
    std::memcpy(&value, &bits, sizeof value);
    ASSERT_EQ(ParseFloat(FormatFloat(value)), value) << FormatFloat(value);
  }
}

}  // namespace
}  // namespace albtpu::formats
