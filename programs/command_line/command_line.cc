#include "programs/command_line/command_line.h"

#include <poll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/str_split.h"
#include "formats/text/text.h"

namespace albtpu::programs {
CLI::Validator NotEmpty(const std::string& what) {
  return CLI::Validator(
      [what](const std::string& text) { return text.empty() ? "is empty; name a " + what : std::string(); }, "");
}

CLI::Validator WholeIn(long long least, long long most) {
  return CLI::Validator(
      [least, most](const std::string& text) -> std::string {
        long long number = 0;
        const char* last = text.data() + text.size();
        const auto [end, error] = std::from_chars(text.data(), last, number);
        if (error == std::errc() && end == last && number >= least && number <= most) return {};
        return absl::StrCat("'", text, "' is not a number in the range; give a whole number from ", least, " to ",
                            most);
      },
      "");
}

CLI::Validator NumberIn(double least, double most, const std::string& unit) {
  return CLI::Validator(
      [least, most, unit](const std::string& text) -> std::string {
        double number = 0;
        if (absl::SimpleAtod(text, &number) && number >= least && number <= most) return {};
        return absl::StrCat("'", text, "' is not a number in the range; give one from ", least, " to ", most, " ",
                            unit);
      },
      "");
}

CLI::Validator OneOf(const std::vector<std::string>& words) {
  return CLI::Validator(
      [words](const std::string& text) -> std::string {
        if (std::find(words.begin(), words.end(), text) != words.end()) return {};
        const std::string choices = absl::StrJoin(words, ", ");
        const std::optional<std::string> near = formats::NearMatch(text, words);
        return near ? absl::StrCat("'", text, "' is unknown (there are ", choices, "); did you mean ", *near, "?")
                    : absl::StrCat("'", text, "' is unknown; give one of ", choices);
      },
      "");
}

namespace {

template <typename Value>
CLI::Option* AddItems(CLI::App& app, const std::string& flag, std::vector<Value>& values,
                      const std::string& description, const CLI::Validator& check) {
  const auto read = [flag, &values, check](const std::vector<std::string>& texts) {
    values.clear();
    for (const std::string& text : texts) {
      for (std::string item : std::vector<std::string>(absl::StrSplit(text, ','))) {
        if (const std::string problem = check(item); !problem.empty()) throw CLI::ValidationError(flag, problem);
        CLI::detail::lexical_cast(item, values.emplace_back());
      }
    }
  };
  return app.add_option_function<std::vector<std::string>>(flag, read, description);
}

}  // namespace

CLI::Option* AddList(CLI::App& app, const std::string& flag, std::vector<double>& values,
                     const std::string& description, const CLI::Validator& check) {
  return AddItems(app, flag, values, description, check)->type_name("FLOAT");
}

CLI::Option* AddList(CLI::App& app, const std::string& flag, std::vector<std::string>& values,
                     const std::string& description, const CLI::Validator& check) {
  return AddItems(app, flag, values, description, check);
}

namespace {

// CLI11's own layout with one empty line, not two, between groups of options.
class Layout : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    return absl::StrReplaceAll(CLI::Formatter::make_help(app, std::move(name), mode), {{"\n\n\n", "\n\n"}});
  }
};

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
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
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
  for (const CLI::App* command : program.get_subcommands({}))
    if (HasOption(*command, name)) others.push_back(command->get_name());
  if (!others.empty()) {
    return absl::StrCat(problem, " (commands with it: ", absl::StrJoin(others, ", "), "); ",
                        &app == &program ? "put it after the command" : "leave it out");
  }
  return absl::StrCat(problem, formats::Suggestion(name, OptionNames(app), SeeHelp(app)));
}

bool LooksLikeAnOption(const std::string& argument) {
  return argument.size() > 1 && argument[0] == '-' && argument.find_first_not_of("+-.0123456789") != std::string::npos;
}

// About the first of the arguments that `app` could not place, options before words: after an unknown option, CLI11
// leaves its value over as well.
std::optional<std::string> LeftOver(const CLI::App& app) {
  const std::vector<std::string> arguments = app.remaining();
  if (arguments.empty()) return std::nullopt;
  const auto option = std::find_if(arguments.begin(), arguments.end(), LooksLikeAnOption);
  if (option != arguments.end()) return NotAnOption(app, *option);
  if (!app.get_subcommands({}).empty()) return NotACommand(app, arguments.front());
  return absl::StrCat("'", arguments.front(), "' is one word too many for ", FullName(app), "; ", SeeHelp(app));
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

std::string FullName(const CLI::App& app) {
  const CLI::App* parent = app.get_parent();
  return parent == nullptr ? app.get_name() : absl::StrCat(FullName(*parent), " ", app.get_name());
}

void SetUpProgram(CLI::App& program, std::string_view version, std::string_view commit,
                  const std::function<std::string()>& more) {
  program.formatter(std::make_shared<Layout>());
  const std::string text =
      absl::StrCat(program.get_name(), " ", std::string(version), "\ncommit ", std::string(commit));
  program.set_version_flag("--version", [text, more] { return more ? absl::StrCat(text, "\n", more()) : text; });
}

void Group(CLI::App& app, const std::string& heading, const std::vector<std::string>& options) {
  for (const std::string& option : options) app.get_option(option)->group(heading);
}

void EndHelp(CLI::App& app, std::string_view notes, const std::string& example, const std::string& another_example) {
  std::string text(notes);
  absl::StrAppend(&text, notes.empty() ? "" : "\n\n", "Examples:");
  for (const std::string& arguments : {example, another_example})
    absl::StrAppend(&text, "\n  ", FullName(app), arguments.empty() ? "" : " ", arguments);
  app.footer(text);
}

std::string UsageMessage(const CLI::App& program, const CLI::ParseError& error) {
  const std::vector<CLI::App*> given = program.get_subcommands();
  if (MayComeOfAMisspeltWord(error)) {
    if (const std::optional<std::string> problem = LeftOver(program)) return *problem;
    for (const CLI::App* command : given)
      if (const std::optional<std::string> problem = LeftOver(*command)) return *problem;
  }
  const CLI::App& app = given.empty() ? program : *given.front();
  if (HasCommandToChoose(app)) return absl::StrCat("no command is given ", CommandList(app), "; ", SeeHelp(app));
  if (static_cast<CLI::ExitCodes>(error.get_exit_code()) == CLI::ExitCodes::ValidationError)
    return error.what();  // It has a suggestion of its own.
  return absl::StrCat(error.what(), "; ", SeeHelp(app));
}

absl::Status FlushStandardOutput() {
  const bool streamed = static_cast<bool>(std::cout.flush());
  const bool printed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (streamed && printed) return absl::OkStatus();
  return absl::DataLossError("standard output: cannot be written; redirect it to a place with free space");
}

absl::Status FlushText() {
  absl::Status status = FlushStandardOutput();
  pollfd output = {.fd = STDOUT_FILENO, .events = POLLOUT, .revents = 0};
  const bool is_closed = poll(&output, 1, 0) == 1 && (output.revents & (POLLERR | POLLHUP)) != 0;
  return is_closed ? absl::OkStatus() : status;
}

}  // namespace albtpu::programs
