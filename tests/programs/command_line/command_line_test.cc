#include "programs/command_line/command_line.h"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

namespace albtpu::programs {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

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

class ListTest : public ::testing::Test {
 protected:
  ListTest() { AddList(app_, "--depth", depths_, "Depths [m]", NumberIn(0, 100, "m")); }

  std::vector<double> Depths(const std::vector<std::string>& arguments) {
    app_.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    return depths_;
  }

  CLI::App app_;
  std::vector<double> depths_ = {7};
};

TEST_F(ListTest, TakesNumbersWithCommasOrOneAfterTheOther) {
  EXPECT_EQ(Depths({}), (std::vector<double>{7}));
  EXPECT_EQ(Depths({"--depth", "1"}), (std::vector<double>{1}));
  EXPECT_EQ(Depths({"--depth", "1,2.5"}), (std::vector<double>{1, 2.5}));
  EXPECT_EQ(Depths({"--depth", "1", "2.5,4"}), (std::vector<double>{1, 2.5, 4}));
}

TEST_F(ListTest, RefusesWhatIsNoNumberAndWhatIsEmpty) {
  for (const std::string text : {"1,,2", ",1", "1,", "", "1,a", "1,101"})
    EXPECT_THROW(Depths({"--depth", text}), CLI::ValidationError) << text;
}

class HelpTest : public ::testing::Test {
 protected:
  HelpTest() {
    SetUpProgram(program_, "1.2", "abc", [] { return std::string("table survey 9b1c"); });
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
    EXPECT_STREQ(version.what(), "ask 1.2\ncommit abc\ntable survey 9b1c");
  }
}

// The message for `arguments` of a program with two commands; empty if they are fine.
std::string MessageFor(std::vector<std::string> arguments) {
  CLI::App program("", "ask");
  program.require_subcommand(1);
  double depth = 0;
  bool overwrite = false;
  std::string profile, file;
  CLI::App* pulse = program.add_subcommand("pulse");
  pulse->add_option("--depth", depth)->required();
  pulse->add_option("--profile", profile)->check(OneOf({"uniform", "gaussian"}));
  CLI::App* csv = program.add_subcommand("csv");
  csv->add_option("file", file);
  CLI::Option* key = csv->add_option("--tls-key", file);
  csv->add_option("--tls-cert", file)->needs(key);
  csv->add_flag("--overwrite", overwrite);
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the end.
  try {
    program.parse(arguments);
  } catch (const CLI::ParseError& error) {
    return UsageMessage(program, error);
  }
  return "";
}

TEST(UsageMessage, IsEmptyForArgumentsThatAreFine) { EXPECT_EQ(MessageFor({"pulse", "--depth", "3"}), ""); }

TEST(UsageMessage, NamesTheCommandsAndTheNearestOne) {
  EXPECT_EQ(MessageFor({"plus"}), "'plus' is not a command (commands: pulse, csv); did you mean pulse?");
  EXPECT_EQ(MessageFor({"foo"}), "'foo' is not a command (commands: pulse, csv); see ask --help");
  EXPECT_EQ(MessageFor({}), "no command is given (commands: pulse, csv); see ask --help");
}

TEST(UsageMessage, NamesTheNearestOption) {
  EXPECT_EQ(MessageFor({"pulse", "--deph", "3"}), "--deph is not an option of ask pulse; did you mean --depth?");
  EXPECT_EQ(MessageFor({"pulse", "--depth", "3", "--deph=3"}),
            "--deph is not an option of ask pulse; did you mean --depth?");
  EXPECT_EQ(MessageFor({"csv", "--nonsense"}), "--nonsense is not an option of ask csv; see ask csv --help");
}

TEST(UsageMessage, PutsAMisspeltOptionBeforeTheOneThatIsMissing) {
  EXPECT_EQ(MessageFor({"csv", "--tls-cert", "c", "--tls-kye", "k"}),
            "--tls-kye is not an option of ask csv; did you mean --tls-key?");
}

TEST(UsageMessage, SaysWhichCommandsHaveAnOption) {
  EXPECT_EQ(MessageFor({"pulse", "--depth", "3", "--overwrite"}),
            "--overwrite is not an option of ask pulse (commands with it: csv); leave it out");
  EXPECT_EQ(MessageFor({"--overwrite", "csv"}),
            "--overwrite is not an option of ask (commands with it: csv); put it after the command");
}

TEST(UsageMessage, NamesAWordTooMany) {
  EXPECT_EQ(MessageFor({"pulse", "--depth", "3", "4"}), "'4' is one word too many for ask pulse; see ask pulse --help");
  EXPECT_EQ(MessageFor({"pulse", "--depth", "3", "-4"}),
            "'-4' is one word too many for ask pulse; see ask pulse --help");
}

TEST(UsageMessage, SaysWhatIsMissing) {
  EXPECT_EQ(MessageFor({"pulse"}), "--depth is required; see ask pulse --help");
  EXPECT_EQ(MessageFor({"csv", "--tls-cert", "c"}), "--tls-cert requires --tls-key; see ask csv --help");
}

TEST(UsageMessage, LeavesAWrongValueToItsCheck) {
  EXPECT_EQ(MessageFor({"pulse", "--depth", "3", "--profile", "square"}),
            "--profile: 'square' is unknown; give one of uniform, gaussian");
}

}  // namespace
}  // namespace albtpu::programs
