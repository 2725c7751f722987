#include <gtest/gtest.h>

#include "formats/text/text.h"

namespace albtpu::formats {
namespace {

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
