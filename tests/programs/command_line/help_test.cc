#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <string>

#include "programs/command_line/command_line.h"

namespace albtpu::programs {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

class HelpTest : public ::testing::Test {
 protected:
  HelpTest() {
    SetUpProgram(program_, "1.2", "abc");
    command_ = program_.add_subcommand("pulse", "Ask for one pulse");
    command_->add_option("--depth", number_, "Depth [m]");
    command_->add_option("--fetch", number_, "Fetch [m]");
    Group(*command_, "The sea", {"--fetch"});
    Group(*command_, "The pulse", {"--depth"});
    EndHelp(*command_, "Notes.", "--depth 3", "");
  }

  CLI::App program_{"Asks", "ask"};
  CLI::App* command_ = nullptr;
  double number_ = 0;
};

TEST_F(HelpTest, KnowsTheFullNameOfACommand) {
  EXPECT_EQ(FullName(program_), "ask");
  EXPECT_EQ(FullName(*command_), "ask pulse");
}

TEST_F(HelpTest, ListsOptionsInGroupsAndEndsWithExamples) {
  const std::string help = command_->help();
  EXPECT_THAT(help, HasSubstr("\n\nThe pulse:\n  --depth"));
  EXPECT_THAT(help, HasSubstr("\n\nThe sea:\n  --fetch"));
  EXPECT_THAT(help, Not(HasSubstr("\n\n\n")));
  EXPECT_THAT(help, EndsWith("\nNotes.\n\nExamples:\n  ask pulse --depth 3\n  ask pulse\n"));
}

TEST_F(HelpTest, StatesTheVersion) {
  try {
    program_.parse(std::vector<std::string>{"--version"});
    FAIL();
  } catch (const CLI::CallForVersion& version) {
    EXPECT_STREQ(version.what(), "ask 1.2 (abc)");
  }
}

}  // namespace
}  // namespace albtpu::programs
