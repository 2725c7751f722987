#include "tables/provenance.h"

#include <gmock/gmock.h>

namespace albtpu {
namespace {

using ::testing::HasSubstr;

Provenance Good() {
  return {.id = "quick", .version = "1", .title = "A title", .campaign = "seed = 1\n", .attributes = {}};
}

std::string Problem(const Provenance& provenance) {
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

TEST(Provenance, RefusesIdsThatAreNotNames) {
  for (const char* id : {"", "-a", "_a", "Quick", "a b", "a/b", "a.b", "ä"}) {
    Provenance provenance = Good();
    provenance.id = id;
    EXPECT_THAT(Problem(provenance), HasSubstr("attribute 'id' is '")) << id;
  }
}

TEST(Provenance, RefusesAnEmptyVersion) {
  Provenance provenance = Good();
  provenance.version = "";
  EXPECT_THAT(Problem(provenance), HasSubstr("'version' is empty"));
}

TEST(Provenance, RefusesATitleOfTwoLines) {
  Provenance provenance = Good();
  provenance.title = "one\ntwo";
  EXPECT_THAT(Problem(provenance), HasSubstr("'title' has several lines"));
}

TEST(Provenance, RefusesTextThatIsNotUtf8) {
  // A lone continuation byte, an overlong slash, a surrogate, a character above U+10FFFF, and a truncated character.
  for (const char* bad : {"\x80", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE6\xB5"}) {
    Provenance provenance = Good();
    provenance.attributes["source"] = "ab" + std::string(bad);
    EXPECT_THAT(Problem(provenance), HasSubstr("attribute 'source' is not UTF-8 at byte 2"));
  }
}

TEST(Provenance, RefusesNulInText) {
  Provenance provenance = Good();
  provenance.campaign = std::string("a\0b", 3);
  EXPECT_THAT(Problem(provenance), HasSubstr("attribute 'campaign' has a NUL at byte 1"));
}

TEST(Provenance, RefusesReservedAndInvalidAttributeNames) {
  for (const char* name : {"id", "Conventions", "content_digest", "coverage"}) {
    Provenance provenance = Good();
    provenance.attributes[name] = std::int64_t{1};
    EXPECT_THAT(Problem(provenance), HasSubstr("is reserved")) << name;
  }
  for (const char* name : {"", "1st", "a b", "a/b", "é"}) {
    Provenance provenance = Good();
    provenance.attributes[name] = std::int64_t{1};
    EXPECT_THAT(Problem(provenance), HasSubstr("letters, digits and underscores")) << name;
  }
}

}  // namespace
}  // namespace albtpu
