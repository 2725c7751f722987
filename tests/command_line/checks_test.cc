#include "command_line/checks.h"

#include <gtest/gtest.h>

namespace albtpu {
namespace {

std::string ProblemOf(const CLI::Validator& check, std::string text) { return check(text); }

TEST(NotEmpty, RefusesOnlyTheEmptyText) {
  EXPECT_EQ(ProblemOf(NotEmpty("file"), "a.pem"), "");
  EXPECT_EQ(ProblemOf(NotEmpty("file"), ""), "is empty; name a file");
}

TEST(OneOf, NamesTheChoicesAndANearMatch) {
  const CLI::Validator check = OneOf({"uniform", "gaussian"});
  EXPECT_EQ(ProblemOf(check, "uniform"), "");
  EXPECT_EQ(ProblemOf(check, "unifrom"),
            "'unifrom' is unknown (there are uniform, gaussian); did you mean uniform?");
  EXPECT_EQ(ProblemOf(check, "square"), "'square' is unknown; give one of uniform, gaussian");
}

}  // namespace
}  // namespace albtpu
