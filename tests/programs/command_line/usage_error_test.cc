#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "programs/command_line/command_line.h"

namespace albtpu::programs {
namespace {

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
