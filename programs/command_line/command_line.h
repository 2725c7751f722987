// What the programs share on the command line: checks of option values, --help and --version, messages about wrong
// arguments, and the end of standard output.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "programs/command_line/cli_fwd.h"

namespace albtpu::programs {

// Checks of option values that several programs use. Each returns the problem, as CLI11 requires.

// A text that is not empty, such as the name of a `what`.
CLI::Validator NotEmpty(const std::string& what);

// A whole number from `least` to `most`.
CLI::Validator WholeIn(long long least, long long most);

// A number from `least` to `most` in a `unit`: "m".
CLI::Validator NumberIn(double least, double most, const std::string& unit);

// One of `words`; a near match is named.
CLI::Validator OneOf(const std::vector<std::string>& words);

// Adds an option of several values, with commas between them or one after the other, each of which passes `check`. An
// empty one is refused, as in "5,,6"; CLI11's own delimiter leaves it out.
CLI::Option* AddList(CLI::App& app, const std::string& flag, std::vector<double>& values,
                     const std::string& description, const CLI::Validator& check);
CLI::Option* AddList(CLI::App& app, const std::string& flag, std::vector<std::string>& values,
                     const std::string& description, const CLI::Validator& check);

// The output of --help and --version.

// "albtpu-query pulse": the names of the program and of the command, if `app` is one.
std::string FullName(const CLI::App& app);

// Gives `program`, which has no command yet, a layout of --help that its commands inherit, and --version: a line
// "NAME VERSION", a line "commit COMMIT", and the lines that `more` returns, without the last line's end.
void SetUpProgram(CLI::App& program, std::string_view version, std::string_view commit,
                  const std::function<std::string()>& more = {});

// Lists the options of these names ("--depth") of `app` under a heading of --help.
void Group(CLI::App& app, const std::string& heading, const std::vector<std::string>& options);

// Ends the help of `app` with `notes`, which may be empty, and with two examples: what follows the name of the app, as
// "--campaign bay.toml --output bay.h5".
void EndHelp(CLI::App& app, std::string_view notes, const std::string& example, const std::string& another_example);

// Messages about arguments that a program does not take.

// One line, `PROBLEM (WHY); SUGGESTION`, about the arguments that `program` failed to parse with `error`. A command or
// an option that does not exist is named before anything that is missing, with the near match if there is one, for it
// may be what is missing, misspelt.
std::string UsageMessage(const CLI::App& program, const CLI::ParseError& error);

// The end of standard output.

// Flushes standard output. DataLoss if any of what was printed could not be written, to a full disk for example.
absl::Status FlushStandardOutput();

// The same after a text for people, such as help: whoever closes a pipe has read enough of it.
absl::Status FlushText();

}  // namespace albtpu::programs
