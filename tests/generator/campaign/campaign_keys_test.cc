#include "generator/campaign/campaign_keys.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "generator/campaign/campaign.h"

namespace albtpu {
namespace {

using ::testing::HasSubstr;

// The values of keys by table and name, as TOML. In so light a wind the ends of every range may be given.
using Values = std::map<std::string, std::map<std::string, std::string>>;

Values SmallCampaign() {
  return {{"", {{"id", "\"small\""}, {"version", "\"1\""}, {"title", "\"Small\""}}},
          {"axes",
           {{"wind_speed", "[1]"},
            {"fetch", "[inf]"},
            {"incidence", "[10]"},
            {"azimuth", "[30]"},
            {"footprint", "[1]"},
            {"depth", "[10]"}}}};
}

// What is wrong with the small campaign with `value` for `key`; empty if nothing is.
std::string ProblemWith(const CampaignKey& key, const std::string& value) {
  Values values = SmallCampaign();
  values[std::string(key.table)][std::string(key.name)] = value;
  std::string text;
  for (const auto& [table, keys] : values) {
    if (!table.empty()) absl::StrAppend(&text, "[", table, "]\n");
    for (const auto& [name, content] : keys) absl::StrAppend(&text, name, " = ", content, "\n");
  }
  return std::string(ParseCampaign(text).status().message());
}

std::string Toml(double number) { return std::isinf(number) ? (number > 0 ? "inf" : "-inf") : absl::StrCat(number); }

TEST(CampaignKeys, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const CampaignKey& key : kCampaignKeys) EXPECT_TRUE(names.insert(FullName(key)).second) << FullName(key);
}

TEST(CampaignKeys, AreThoseThatACampaignReads) {
  std::map<std::string, std::set<std::string>> tables;
  for (const CampaignKey& key : kCampaignKeys) tables[std::string(key.table)].emplace(key.name);
  for (const auto& [table, names] : tables) {
    if (table.empty()) continue;
    std::string listed;
    for (const std::string& name : names) absl::StrAppend(&listed, listed.empty() ? "" : ", ", name);
    const CampaignKey unknown = {table, "colors_of_the_sea", AnyText{}, "", Required{}, ""};
    EXPECT_THAT(ProblemWith(unknown, "1"), ::testing::EndsWith("; there are " + listed));
  }
}

TEST(CampaignKeys, AreRequiredUnlessTheyHaveADefault) {
  EXPECT_EQ(ProblemWith(campaign_keys::kTitle, "\"Small\""), "");
  const Values required = SmallCampaign();
  for (const CampaignKey& key : kCampaignKeys) {
    const auto table = required.find(std::string(key.table));
    const bool given = table != required.end() && table->second.contains(std::string(key.name));
    EXPECT_EQ(std::holds_alternative<Required>(key.absent), given) << FullName(key);
  }
}

TEST(CampaignKeys, TakeTheEndsOfTheirRangesAndNothingBeyond) {
  for (const CampaignKey& key : kCampaignKeys) {
    SCOPED_TRACE(FullName(key));
    if (const auto* range = std::get_if<NumberRange>(&key.values)) {
      for (const double end : {range->least, range->most}) EXPECT_EQ(ProblemWith(key, Toml(end)), "") << end;
      EXPECT_THAT(ProblemWith(key, Toml(0.99 * range->least)), HasSubstr("(expected "));
      EXPECT_TRUE(std::isinf(range->most) ||
                  absl::StrContains(ProblemWith(key, Toml(1.01 * range->most)), "(expected "));
    }
    if (const auto* range = std::get_if<WholeRange>(&key.values)) {
      EXPECT_THAT(ProblemWith(key, absl::StrCat(range->least - 1)), HasSubstr("(expected a whole number from "));
      EXPECT_EQ(ProblemWith(key, absl::StrCat(range->most)), "");
      EXPECT_TRUE(range->most == std::numeric_limits<std::int64_t>::max() ||
                  absl::StrContains(ProblemWith(key, absl::StrCat(range->most + 1)), "(expected a whole number from "));
      // `most_realizations` must not be below the default of `realizations`.
      const bool is_most = FullName(key) == "effort.most_realizations";
      EXPECT_EQ(ProblemWith(key, absl::StrCat(is_most ? 1000 : range->least)), "");
    }
    if (const auto* choice = std::get_if<Choice>(&key.values)) {
      for (const std::string_view word : choice->words)
        EXPECT_EQ(ProblemWith(key, absl::StrCat("\"", std::string(word), "\"")), "");
      EXPECT_THAT(ProblemWith(key, "\"neither\""), HasSubstr("is 'neither' (expected "));
    }
  }
}

TEST(CampaignKeys, TakeNodesInTheirRangesOnly) {
  for (const CampaignKey& key : kCampaignKeys) {
    const auto* range = std::get_if<NodeRange>(&key.values);
    if (range == nullptr) continue;
    SCOPED_TRACE(FullName(key));
    const std::string end = key.name == "fetch" ? ", inf]" : "]";  // its last node
    EXPECT_EQ(ProblemWith(key, absl::StrCat("[", range->least, end)).empty(), range->includes_least);
    EXPECT_NE(ProblemWith(key, absl::StrCat("[", range->least - 1, end)), "");
    if (std::isinf(range->most)) continue;
    EXPECT_EQ(ProblemWith(key, absl::StrCat("[", range->most, "]")), "");
    EXPECT_THAT(ProblemWith(key, absl::StrCat("[", range->most + 0.5, "]")), HasSubstr(std::string(range->why_most)));
  }
}

TEST(CampaignKeys, TakeTheirDefaultsAsTheStructsHaveThem) {
  const Campaign campaign = ParseCampaign(R"(id = "a"
version = "1"
title = "A"
axes = {wind_speed=[5], fetch=[inf], incidence=[0], azimuth=[0], footprint=[1], depth=[1]}
)")
                                .value();
  EXPECT_EQ(campaign.wind_sea.spreading, WindSea().spreading);
  EXPECT_EQ(WindSea().spreading, 2);
  EXPECT_EQ(std::get<double>(campaign_keys::kCorrectedAbove.absent), campaign.corrected_above);
  EXPECT_EQ(std::get<std::string_view>(campaign_keys::kSpectrum.absent), campaign.wind_sea.model->key);
  EXPECT_EQ(campaign.effort.realizations, 1000);
  EXPECT_EQ(campaign.effort.relative_error, 0);
  EXPECT_THAT(std::string(std::get<Derived>(campaign_keys::kMaxRealizationsOfBeam.absent).rule),
              HasSubstr(absl::StrCat(campaign_keys::kMaxRealizationsUnlessGiven)));
  EXPECT_EQ(campaign.effort.estimator, Estimator::kControlVariate);
  EXPECT_EQ(campaign.seed, 1u);
  EXPECT_EQ(campaign.checked_pulses, 40u);
  EXPECT_EQ(campaign.refractive_index, 1.33);
  EXPECT_TRUE(std::isinf(campaign.source_height));
  EXPECT_FALSE(campaign.balanced_nodes);
}

TEST(CampaignReference, HasARowForEachKey) {
  const std::string page = CampaignReference();
  for (const CampaignKey& key : kCampaignKeys) EXPECT_THAT(page, HasSubstr("| `" + std::string(key.name) + "`"));
}

TEST(CampaignReference, ShowsACampaignThatCanBeRead) {
  const std::string page = CampaignReference();
  const std::string begin = "```toml\n";
  const std::size_t at = page.find(begin) + begin.size();
  const absl::StatusOr<Campaign> campaign = ParseCampaign(page.substr(at, page.find("```", at) - at));
  EXPECT_TRUE(campaign.ok()) << campaign.status();
}

}  // namespace
}  // namespace albtpu
