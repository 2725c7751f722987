#include "programs/command_line/usage_error.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "formats/text/near_match.h"
#include "programs/command_line/help.h"

namespace albtpu::programs {
namespace {

std::string SeeHelp(const CLI::App& app) { return absl::StrCat("see ", FullName(app), " --help"); }

std::vector<std::string> CommandNames(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::string CommandList(const CLI::App& program) {
  return absl::StrCat("(commands: ", absl::StrJoin(CommandNames(program), ", "), ")");
}

std::vector<std::string> OptionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

bool HasOption(const CLI::App& app, const std::string& name) {
  const std::vector<std::string> names = OptionNames(app);
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string NotACommand(const CLI::App& program, const std::string& word) {
  return absl::StrCat("'", word, "' is not a command ", CommandList(program),
                      formats::Suggestion(word, CommandNames(program), SeeHelp(program)));
}

// `argument` is --name, --name=value or -n.
std::string NotAnOption(const CLI::App& app, const std::string& argument) {
  const std::string name = argument.substr(0, argument.find('='));
  const std::string problem = absl::StrCat(name, " is not an option of ", FullName(app));
  const CLI::App& program = app.get_parent() == nullptr ? app : *app.get_parent();
  std::vector<std::string> others;
  for (const CLI::App* command : program.get_subcommands({})) {
    if (HasOption(*command, name)) others.push_back(command->get_name());
  }
  if (!others.empty()) {
    return absl::StrCat(problem, " (commands with it: ", absl::StrJoin(others, ", "), "); ",
                        &app == &program ? "put it after the command" : "leave it out");
  }
  return absl::StrCat(problem, formats::Suggestion(name, OptionNames(app), SeeHelp(app)));
}

bool LooksLikeAnOption(const std::string& argument) {
  return argument.size() > 1 && argument[0] == '-' &&
         argument.find_first_not_of("+-.0123456789") != std::string::npos;
}

// About the first of the arguments that `app` could not place, options before words: after an unknown option, CLI11
// leaves its value over as well.
std::optional<std::string> LeftOver(const CLI::App& app) {
  const std::vector<std::string> arguments = app.remaining();
  if (arguments.empty()) return std::nullopt;
  const auto option = std::find_if(arguments.begin(), arguments.end(), LooksLikeAnOption);
  if (option != arguments.end()) return NotAnOption(app, *option);
  if (!app.get_subcommands({}).empty()) return NotACommand(app, arguments.front());
  return absl::StrCat("'", arguments.front(), "' is one word too many for ", FullName(app), "; ",
                      SeeHelp(app));
}

bool HasCommandToChoose(const CLI::App& app) {
  return !app.get_subcommands({}).empty() && app.get_subcommands().empty();
}

// Errors of this kind may come of a misspelt command or option.
bool MayComeOfAMisspeltWord(const CLI::ParseError& error) {
  const auto code = static_cast<CLI::ExitCodes>(error.get_exit_code());
  return code == CLI::ExitCodes::ExtrasError || code == CLI::ExitCodes::RequiredError ||
         code == CLI::ExitCodes::RequiresError;
}

}  // namespace

std::string UsageMessage(const CLI::App& program, const CLI::ParseError& error) {
  const std::vector<CLI::App*> given = program.get_subcommands();
  if (MayComeOfAMisspeltWord(error)) {
    if (const std::optional<std::string> problem = LeftOver(program)) return *problem;
    for (const CLI::App* command : given) {
      if (const std::optional<std::string> problem = LeftOver(*command)) return *problem;
    }
  }
  const CLI::App& app = given.empty() ? program : *given.front();
  if (HasCommandToChoose(app)) {
    return absl::StrCat("no command is given ", CommandList(app), "; ", SeeHelp(app));
  }
  if (static_cast<CLI::ExitCodes>(error.get_exit_code()) == CLI::ExitCodes::ValidationError) {
    return error.what();  // It has a suggestion of its own.
  }
  return absl::StrCat(error.what(), "; ", SeeHelp(app));
}

}  // namespace albtpu::programs
