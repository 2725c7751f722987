#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include "programs/command_line/command_line.h"

namespace albtpu::programs {
namespace {

std::string ProblemOf(const CLI::Validator& check, std::string text) { return check(text); }

TEST(NotEmpty, RefusesOnlyTheEmptyText) {
  EXPECT_EQ(ProblemOf(NotEmpty("file"), "a.pem"), "");
  EXPECT_EQ(ProblemOf(NotEmpty("file"), ""), "is empty; name a file");
}

TEST(WholeIn, RefusesWhatIsOutOfRangeOrNotAWholeNumber) {
  const CLI::Validator check = WholeIn(1, 4096);
  EXPECT_EQ(ProblemOf(check, "1"), "");
  EXPECT_EQ(ProblemOf(check, "4096"), "");
  for (const std::string text : {"0", "4097", "2.5", "two", "", "99999999999999999999"}) {
    EXPECT_EQ(ProblemOf(check, text),
              "'" + text + "' is not a number in the range; give a whole number from 1 to 4096");
  }
}

TEST(OneOf, NamesTheChoicesAndANearMatch) {
  const CLI::Validator check = OneOf({"uniform", "gaussian"});
  EXPECT_EQ(ProblemOf(check, "uniform"), "");
  EXPECT_EQ(ProblemOf(check, "unifrom"), "'unifrom' is unknown (there are uniform, gaussian); did you mean uniform?");
  EXPECT_EQ(ProblemOf(check, "square"), "'square' is unknown; give one of uniform, gaussian");
}

}  // namespace
}  // namespace albtpu::programs
