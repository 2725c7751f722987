#include "formats/text/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

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

TEST(PercentText, HasTwoSignificantDigitsAndAllBeforeThePoint) {
  EXPECT_EQ(PercentText(0.002761), "0.28 %");
  EXPECT_EQ(PercentText(0.0104), "1 %");
  EXPECT_EQ(PercentText(0.0112), "1.1 %");
  EXPECT_EQ(PercentText(0.18), "18 %");
  EXPECT_EQ(PercentText(1.234), "123 %");
  EXPECT_EQ(PercentText(0), "0 %");
}

TEST(OneLine, ReplacesControlCharactersOnly) {
  EXPECT_EQ(OneLine("expected 'nan', saw 'n\n'\t\x7f"), "expected 'nan', saw 'n?'??");
  EXPECT_EQ(OneLine("4 °C"), "4 °C");
}

const std::vector<std::string> kCommands = {"pulse", "csv", "las", "tables", "health"};

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(EditDistance("", ""), 0u);
  EXPECT_EQ(EditDistance("depth", "depth"), 0u);
  EXPECT_EQ(EditDistance("", "las"), 3u);
  EXPECT_EQ(EditDistance("deph", "depth"), 1u);
  EXPECT_EQ(EditDistance("deppth", "depth"), 1u);
  EXPECT_EQ(EditDistance("dipth", "depth"), 1u);
  EXPECT_EQ(EditDistance("detph", "depth"), 1u);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3u);
}

TEST(EditDistance, IsTheSameInBothDirections) {
  for (const std::string& a : kCommands)
    for (const std::string& b : kCommands) EXPECT_EQ(EditDistance(a, b), EditDistance(b, a)) << a << " " << b;
}

TEST(NearMatch, FindsAMisspeltWord) {
  EXPECT_EQ(NearMatch("plus", {"pulse", "point"}), "pulse");
  EXPECT_EQ(NearMatch("tabels", kCommands), "tables");
  EXPECT_EQ(NearMatch("cvs", kCommands), "csv");
  EXPECT_EQ(NearMatch("--wind-sped", {"--wind-from", "--wind-speed"}), "--wind-speed");
}

TEST(NearMatch, SuggestsNothingThatIsFarAway) {
  EXPECT_EQ(NearMatch("foo", kCommands), std::nullopt);
  EXPECT_EQ(NearMatch("x", kCommands), std::nullopt);
  EXPECT_EQ(NearMatch("--nonsense", {"--depth", "--incidence"}), std::nullopt);
  EXPECT_EQ(NearMatch("pulse", {}), std::nullopt);
}

TEST(NearMatch, PrefersTheNearestAndThenTheFirst) {
  EXPECT_EQ(NearMatch("tls-kex", {"tls-cert", "tls-keys", "tls-key"}), "tls-key");
  EXPECT_EQ(NearMatch("noda", {"node", "nods"}), "node");
}

TEST(NearMatch, AllowsNoMoreThanThreeEditsOfALongWord) {
  EXPECT_EQ(NearMatch("refractive_indices", {"refractive_index"}), "refractive_index");
  EXPECT_EQ(NearMatch("a_very_long_name_of_a_key", {"another_long_name_of_a_key"}), std::nullopt);
}

TEST(Suggestion, AsksOrSaysWhatElseToDo) {
  EXPECT_EQ(Suggestion("pulze", kCommands, "see --help"), "; did you mean pulse?");
  EXPECT_EQ(Suggestion("foo", kCommands, "see --help"), "; see --help");
}

}  // namespace
}  // namespace albtpu::formats
