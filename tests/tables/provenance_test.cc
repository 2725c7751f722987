#include "tables/provenance.h"

#include <gmock/gmock.h>

#include <functional>

namespace albtpu {
namespace {

using ::testing::HasSubstr;

Provenance Good() {
  return {.id = "quick", .version = "1", .title = "A title", .campaign = "seed = 1\n", .attributes = {}};
}

// The message about the good one after `change`.
std::string ProblemAfter(const std::function<void(Provenance&)>& change) {
  Provenance provenance = Good();
  change(provenance);
  const absl::Status status = CheckProvenance(provenance);
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  return std::string(status.message());
}

TEST(Provenance, AcceptsWhatTheRulesAllow) {
  EXPECT_TRUE(CheckProvenance(Good()).ok());
  Provenance provenance = Good();
  provenance.id = "0-survey_2";
  provenance.title = "";
  provenance.campaign = "";
  provenance.attributes = {{"source", std::string("Météo, 海, 🌊")}, {"_x1", 1.5}};
  EXPECT_TRUE(CheckProvenance(provenance).ok());
}

TEST(Provenance, RefusesTextsThatAreNotWhatTheyShouldBe) {
  for (const char* id : {"", "-a", "_a", "Quick", "a b", "a/b", "a.b", "ä"})
    EXPECT_THAT(ProblemAfter([&](Provenance& good) { good.id = id; }), HasSubstr("attribute 'id' is '")) << id;
  EXPECT_THAT(ProblemAfter([](Provenance& good) { good.version = ""; }), HasSubstr("'version' is empty"));
  EXPECT_THAT(ProblemAfter([](Provenance& good) { good.title = "one\ntwo"; }), HasSubstr("'title' has several lines"));
  EXPECT_THAT(ProblemAfter([](Provenance& good) { good.campaign = std::string("a\0b", 3); }),
              HasSubstr("attribute 'campaign' has a NUL at byte 1"));
  // A lone continuation byte, an overlong slash, a surrogate, a character above U+10FFFF, and a truncated character.
  for (const char* bad : {"\x80", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE6\xB5"})
    EXPECT_THAT(ProblemAfter([&](Provenance& good) { good.attributes["source"] = "ab" + std::string(bad); }),
                HasSubstr("attribute 'source' is not UTF-8 at byte 2"));
}

TEST(Provenance, RefusesReservedAndInvalidAttributeNames) {
  const auto problem_of = [](const char* name) {
    return ProblemAfter([&](Provenance& good) { good.attributes[name] = std::int64_t{1}; });
  };
  for (const char* name : {"id", "Conventions", "content_digest", "coverage"})
    EXPECT_THAT(problem_of(name), HasSubstr("is reserved")) << name;
  for (const char* name : {"", "1st", "a b", "a/b", "é"})
    EXPECT_THAT(problem_of(name), HasSubstr("letters, digits and underscores")) << name;
}

}  // namespace
}  // namespace albtpu
