#include "config/key.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "absl/strings/str_cat.h"
#include "config/key_list.h"
#include "config/survey_settings.h"

namespace albtpu::config {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// What a flag says, and what stands in the file.
struct Written {
  std::string flag, file;
};

std::vector<double> BeyondRange(const ValueFacts& values) {
  const auto far = [](double end) { return 0.01 * std::max(1.0, std::abs(end)); };
  std::vector<double> beyond = {*values.least - far(*values.least), -1e12, NAN};
  if (std::isfinite(*values.greatest)) {
    beyond.push_back(*values.greatest + far(*values.greatest));
    beyond.push_back(HUGE_VAL);
  }
  return beyond;
}

// Values that a key does not take: beyond its range, and of another type. Without a flag: those that a flag cannot say.
std::vector<Written> WrongValues(const ValueFacts& values) {
  std::vector<Written> wrong;
  if (values.type == "number" || values.type == "number or path") {
    for (const double number : BeyondRange(values)) wrong.push_back({absl::StrCat(number), absl::StrCat(number)});
    for (const char* text : {"true", "[1]", "{}", "''", "2020-06-08"}) wrong.push_back({"", text});
    if (values.type == "number") wrong.push_back({"much", "'much'"});
  } else if (values.type == "3 numbers") {
    for (const double number : BeyondRange(values)) {
      wrong.push_back({absl::StrCat(number, ",0.1,0.1"), absl::StrCat("[", number, ", 0.1, 0.1]")});
      wrong.push_back({absl::StrCat("0.1,0.1,", number), absl::StrCat("[0.1, 0.1, ", number, "]")});
    }
    for (const char* text : {"0.1,0.1", "0.1,0.1,0.1,0.1", "a,b,c"})
      wrong.push_back({text, absl::StrCat("'", text, "'")});
    for (const char* text : {"1", "[]", "[0.1, 0.1]", "[0.1, 0.1, '1']"}) wrong.push_back({"", text});
  } else if (values.type == "list of whole numbers") {
    for (const char* text : {"-1", "256", "40.5", "a"})
      wrong.push_back({text, absl::StrCat("[", text[0] == 'a' ? "'a'" : text, "]")});
    for (const char* text : {"40", "[]"}) wrong.push_back({"", text});
  } else if (values.type == "true or false") {
    for (const char* text : {"1", "'true'"}) wrong.push_back({"", text});
  } else if (values.type == "list of paths") {
    for (const char* text : {"'a'", "[]", "['']", "[5]"}) wrong.push_back({"", text});
  } else {
    for (const char* text : {"5", "true", "['relax']", "''", "{a = 1}"}) wrong.push_back({"", text});
    if (!values.words.empty()) wrong.push_back({"no-such-word", "'no-such-word'"});
  }
  return wrong;
}

std::string Section(const ListedKey& key) {
  return IsOfMany(key.section) ? absl::StrCat("[[", key.section, "]]\n") : absl::StrCat("[", key.section, "]\n");
}

std::string ErrorOfKey(const ListedKey& key, const std::string& value) {
  const auto survey = ParseSurvey(absl::StrCat(Section(key), key.key, " = ", value, "\n"), "");
  return std::string(survey.status().message());
}

TEST(EachKey, IsRefusedWhereItsValueIsWrong) {
  for (const ListedKey& key : ListKeys()) {
    for (const Written& wrong : WrongValues(key.values)) {
      const std::string error = ErrorOfKey(key, wrong.file);
      EXPECT_THAT(error, StartsWith(absl::StrCat("line 2: '", key.section, ".", key.key, "' "))) << wrong.file;
      EXPECT_THAT(error, HasSubstr("(expected ")) << wrong.file;
      EXPECT_THAT(error, HasSubstr("; ")) << wrong.file;
      EXPECT_THAT(error, Not(EndsWith("give it"))) << wrong.file;
      if (key.flag.empty() || wrong.flag.empty()) continue;
      const absl::StatusOr<Value> value = ParseValue(*FindFlag(key.flag).declaration, wrong.flag);
      ASSERT_FALSE(value.ok()) << key.flag << wrong.flag;
      const std::string by_flag(value.status().message());
      EXPECT_THAT(by_flag, StartsWith(absl::StrCat("is '", wrong.flag, "' (expected ")));
      const std::size_t expected = by_flag.find("(expected ");
      EXPECT_THAT(error, HasSubstr(by_flag.substr(expected, by_flag.find("); ") - expected))) << key.key;
    }
  }
}

TEST(EachKey, NamesTheUnitOrTheRangeOfItsNumber) {
  const auto error_of = [](const char* text) { return std::string(ParseSurvey(text, "").status().message()); };
  EXPECT_EQ(error_of("[water]\nindex = 1.5"),
            "line 2: 'water.index' is 1.5 (expected 1.3 to 1.4); give a number in this range");
  EXPECT_EQ(error_of("[sea]\nwind_speed = 200"),
            "line 2: 'sea.wind_speed' is 200 (expected 0 to 100 m/s); give it in m/s");
}

TEST(EachKey, TakesTheEndsOfItsRange) {
  for (const ListedKey& key : ListKeys()) {
    if (key.values.type != "number") continue;
    for (const double end : {*key.values.least, *key.values.greatest}) {
      const std::string text = absl::StrCat(end);
      EXPECT_THAT(ErrorOfKey(key, text), Not(HasSubstr("expected "))) << key.key;
      if (key.flag.empty()) continue;
      EXPECT_TRUE(ParseValue(*FindFlag(key.flag).declaration, text).ok()) << key.flag;
    }
  }
}

TEST(EachKey, IsOverriddenByItsFlag) {
  ForEachSection([](const char* name, const auto& keys, const auto& section) {
    for (const auto& key : keys) {
      SurveySettings flags, file;
      const auto put = [&](SurveySettings& settings, double number, const char* text) {
        for (const Value& value :
             {Value(number), Value(std::string(text)), Value(number > 1), Value(Triple{number, 0, 0}),
              Value(std::vector<int>{static_cast<int>(number)}), Value(std::vector<std::string>{text})})
          Put(value, key, section(settings));
      };
      put(flags, 1, "flag");
      put(file, 2, "file");
      EXPECT_TRUE(IsGiven(key, section(flags))) << name << key.declaration.key;
      const auto member = key.member;
      std::visit(
          [&](const auto m) {
            const SurveySettings both = Merge(flags, file), alone = Merge({}, file);
            EXPECT_EQ(section(both).*m, section(flags).*m) << key.declaration.key;
            EXPECT_EQ(section(alone).*m, section(file).*m) << key.declaration.key;
          },
          member);
    }
  });
}

TEST(EachKey, HasAFlagOfItsOwnAndAHelp) {
  std::set<std::string> flags;
  for (const ListedKey& key : ListKeys()) {
    EXPECT_FALSE(key.help.empty() || key.help.ends_with('.')) << key.key;
    if (key.flag.empty()) continue;
    EXPECT_TRUE(flags.insert(key.flag).second) << key.flag;
  }
  EXPECT_GT(flags.size(), 25u);
}

TEST(HelpText, HasUnitAndDefault) {
  EXPECT_EQ(HelpText(*FindFlag("--sea-depth").declaration),
            "Depth of the water that the waves travel in [m] (default: as the file states; otherwise deep)");
  EXPECT_EQ(HelpText(*FindFlag("--gamma").declaration), "Peak enhancement of JONSWAP (default: 3.3)");
}

TEST(Flags, HaveListsAndTriples) {
  const auto parsed = [](const char* flag, const char* text) {
    return ParseValue(*FindFlag(flag).declaration, text).value();
  };
  EXPECT_EQ(parsed("--lever-arm", "0.3,-0.2, 0.5"), Value(Triple{0.3, -0.2, 0.5}));
  EXPECT_EQ(parsed("--classes", "26,40"), Value(std::vector<int>{26, 40}));
  EXPECT_EQ(parsed("--water-level", "-23.5"), Value(-23.5));
  EXPECT_EQ(parsed("--water-level", "level.csv"), Value(std::string("level.csv")));
  EXPECT_EQ(parsed("--fetch", "inf"), Value(HUGE_VAL));
}

}  // namespace
}  // namespace albtpu::config
