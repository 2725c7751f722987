#include "sea/files/text_lines.h"

#include <gtest/gtest.h>

#include <utility>

namespace albtpu {
namespace {

TEST(TextLines, EndWithLineFeedsAndMayHaveCarriageReturns) {
  TextLines lines("a\r\n\nb\n");
  EXPECT_EQ(lines.Next(), "a");
  EXPECT_EQ(lines.Next(), "");
  EXPECT_EQ(lines.Next(), "b");
  EXPECT_EQ(lines.number(), 3u);
  EXPECT_FALSE(lines.Next().has_value());
  EXPECT_FALSE(lines.cut());
}

TEST(TextLines, KnowThatALineWithoutEndWasCut) {
  TextLines lines("1.25\n1.2");
  EXPECT_EQ(lines.Next(), "1.25");
  EXPECT_FALSE(lines.Next().has_value());
  EXPECT_TRUE(lines.cut());
}

TEST(TextLines, MayEndAtAColumnOfTheLineBefore) {
  const auto last_is_whole = [](std::string_view text) {
    TextLines lines(text, TextLines::LastLine::kMayEndAtColumn);
    while (lines.Next()) {
    }
    return !lines.cut();
  };
  EXPECT_TRUE(last_is_whole(" 0.12 0.34 0.56\n 0.78"));
  EXPECT_TRUE(last_is_whole(" 0.12 0.34\n 0.78 0.90"));
  EXPECT_FALSE(last_is_whole(" 0.12 0.34\n 0.7"));
  EXPECT_FALSE(last_is_whole(" 0.12 0.34\n 0.78 "));
  EXPECT_FALSE(last_is_whole(" 0.12 0.34\n 0.78 0.90 0.1"));
}

TEST(ParseNumber, TakesDecimalAndFortranForms) {
  EXPECT_EQ(ParseNumber(".03"), 0.03);
  EXPECT_EQ(ParseNumber("-12"), -12);
  EXPECT_EQ(ParseNumber("+1.5"), 1.5);
  EXPECT_EQ(ParseNumber("0.261E-17"), 0.261e-17);
  EXPECT_DOUBLE_EQ(*ParseNumber("0.261-104"), 0.261e-104);
  EXPECT_DOUBLE_EQ(*ParseNumber("0.261+104"), 0.261e104);
  EXPECT_EQ(ParseNumber("1E-400"), 0);
  for (const char* word : {"", "-", "MM", "nan", "inf", "1e400", "1.5x", "0.261-17", "0x10", "1 2", "0.2+1+2", "."})
    EXPECT_FALSE(ParseNumber(word).has_value()) << word;
}

TEST(SecondsOfDigits, AreThoseOfTheDateAndTimeOfDay) {
  EXPECT_EQ(SecondsOfDigits("20220912", "060000"), 1662962400);  // date -u -d 2022-09-12T06:00 +%s
  for (const auto& [date, time_of_day] : {std::pair("2022091", "060000"), std::pair("20220912", "06000x"),
                                          std::pair("20220912", "240000"), std::pair("20220001", "060000")})
    EXPECT_FALSE(SecondsOfDigits(date, time_of_day)) << date << " " << time_of_day;
}

TEST(Quoted, IsShortAndPrintable) {
  EXPECT_EQ(Quoted("a\x01"
                   "b\n"),
            "'a?b?'");
  EXPECT_EQ(Quoted(std::string(100, 'x')), "'" + std::string(24, 'x') + "...'");
}

TEST(WordStream, ReadsNumbersOverLines) {
  WordStream words("1 2\n3 4 x\nnext\n");
  EXPECT_EQ(*words.Numbers(3, "a number"), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(words.NextLine(), "next");
  EXPECT_FALSE(words.Numbers(1, "a number").ok());
}

TEST(WordStream, NamesTheLineOfWhatIsNoNumber) {
  WordStream words("1 2\n3 x\n");
  EXPECT_EQ(words.Numbers(4, "a frequency").status().message(),
            "line 2: 'x' is not a frequency; get another copy of the file");
}

}  // namespace
}  // namespace albtpu
