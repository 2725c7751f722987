#include "config/survey_draft.h"

#include <gmock/gmock.h>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "config/key_list.h"
#include "config/survey_settings.h"

namespace albtpu::config {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::vector<std::string> Lines(const std::string& text) { return absl::StrSplit(text, '\n'); }

TEST(SurveyDraft, HasEachKeyOnceAndIsAnEmptySurvey) {
  const std::string text = DraftText({});
  const absl::StatusOr<SurveySettings> survey = ParseSurvey(text, "");
  ASSERT_TRUE(survey.ok()) << survey.status();
  EXPECT_FALSE(survey->wants_total());
  std::size_t found = 0;
  for (const std::string& line : Lines(text))
    found += !line.empty() && line[0] == '#' && line[1] != ' ' && line[1] != '[';
  EXPECT_EQ(found, ListKeys().size());
}

TEST(SurveyDraft, StatesUnitRangeAndDefaultOfTheTables) {
  const std::string text = DraftText({});
  EXPECT_THAT(text,
              HasSubstr("# Wind speed at 10 m above the sea; 0 is a calm [m/s, 0 to 100]\n#wind_speed = NUMBER\n"));
  EXPECT_THAT(text, HasSubstr("# Single-scattering albedo [0.05 to 0.98; not given: 0.8]\n#omega0 = 0.8\n"));
  EXPECT_THAT(text, HasSubstr("\n#position = [0.02, 0.02, 0.06]\n"));
  EXPECT_THAT(text, HasSubstr("\n#coverage = \"p95\"\n"));
}

// Removes the # of one key after the other; of those in a table of their own, of all at once.
TEST(SurveyDraft, IsReadWithEachKeyThatHasAValue) {
  const std::vector<std::string> lines = Lines(DraftText({}));
  std::size_t read = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!absl::StrContains(lines[i], " = ") || lines[i][1] == ' ') continue;
    if (absl::StrContains(lines[i], "NUMBER") || absl::StrContains(lines[i], "[X") || absl::StrContains(lines[i], "[N"))
      continue;
    std::string section;
    for (std::size_t j = 0; j < i; ++j)
      if (const std::string& line = lines[j]; line.starts_with("[") || line.starts_with("#[")) section = line;
    if (section.starts_with("#") || absl::StrContains(lines[i], "TIME")) continue;
    const absl::StatusOr<SurveySettings> survey = ParseSurvey(absl::StrCat(section, "\n", lines[i].substr(1)), "");
    EXPECT_TRUE(survey.ok()) << section << lines[i] << survey.status();
    ++read;
  }
  EXPECT_GT(read, 25u);
}

TEST(SurveyDraft, HasWhatIsFoundAndWhatMustBeDecided) {
  const std::string text = DraftText({.heading = {"One two.", "  kept as it  is", ""},
                                      .decisions = {{"sea", "--wind-speed is missing; give it, --hs, or --more"}},
                                      .values = {{"surface", "classes", "[41]", "found in the points", true},
                                                 {"sea", "wind_speed", "5", "an example"}}});
  EXPECT_THAT(text, StartsWith("# One two.\n#  kept as it  is\n#\n"));
  EXPECT_THAT(text, HasSubstr("\nclasses = [41]  # found in the points\n"));
  EXPECT_THAT(text, HasSubstr("\n[sea]\n# DECIDE: wind_speed is missing; give it, hs, or --more\n"));
  EXPECT_THAT(text, HasSubstr("\n#wind_speed = 5  # an example\n"));
  const absl::StatusOr<SurveySettings> survey = ParseSurvey(text, "");
  ASSERT_TRUE(survey.ok()) << survey.status();
  EXPECT_THAT(survey->surface.classes, ElementsAre(41));
  EXPECT_FALSE(survey->sea.wind_speed.has_value());
}

TEST(SurveyDraft, WrapsProse) {
  std::string words;
  for (int i = 0; i < 60; ++i) absl::StrAppend(&words, i > 0 ? " " : "", "word");
  for (const std::string& line : Lines(DraftText({.heading = {words}}))) EXPECT_LE(line.size(), 200u) << line;
  EXPECT_THAT(Lines(DraftText({.heading = {words}})).front().size(), ::testing::Le(100u));
}

TEST(SurveyDraft, GivesFlagsOfItsValues) {
  EXPECT_THAT(FlagOf({"surface", "classes", "[41, 42]"}), ElementsAre("--water-classes", "41,42"));
  EXPECT_THAT(FlagOf({"sensor", "name", "\"riegl-vq-880-g\""}), ElementsAre("--sensor", "riegl-vq-880-g"));
  EXPECT_THAT(FlagOf({"trajectory", "from_returns", "true"}), ElementsAre("--trajectory-from-returns"));
}

}  // namespace
}  // namespace albtpu::config
