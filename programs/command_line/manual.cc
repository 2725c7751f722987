#include "programs/command_line/manual.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/str_split.h"
#include "programs/command_line/command_line.h"

namespace albtpu::programs {
namespace {

using Options = std::vector<const CLI::Option*>;
using Commands = std::vector<const CLI::App*>;

// All hyphens are typed as such: a reader may copy any of them.
std::string Escaped(const std::string& text) {
  return absl::StrReplaceAll(text, {{"\\", "\\e"}, {"-", "\\-"}, {"'", "\\(aq"}, {"`", "\\(ga"}});
}

// Of one line, which must not look like a request to troff.
std::string Line(const std::string& text) {
  return absl::StrCat(text.starts_with(".") ? "\\&" : "", Escaped(text), "\n");
}

std::string Bold(const std::string& text) { return absl::StrCat("\\fB", Escaped(text), "\\fR"); }

std::vector<std::string> Lines(const std::string& text) {
  return absl::StrSplit(absl::StripTrailingAsciiWhitespace(text), '\n');
}

bool IsListed(const CLI::Option* option) { return !option->get_group().empty(); }

// The options of `group`, or those without a flag.
Options OptionsOf(const CLI::App& app, const std::string& group, bool positional) {
  return app.get_options([&](const CLI::Option* option) {
    return IsListed(option) && option->nonpositional() != positional && (positional || option->get_group() == group);
  });
}

std::string Terms(const Options& options) {
  const CLI::Formatter help;  // What follows the name of an option is as in --help.
  std::string text;
  for (const CLI::Option* option : options) {
    const std::string name = option->get_name(!option->nonpositional(), true);
    absl::StrAppend(&text, ".TP\n", Bold(absl::StrReplaceAll(name, {{",", ", "}})),
                    Escaped(help.make_option_opts(option)), "\n", Line(option->get_description()));
  }
  return text;
}

// `heading`: of sections or of their parts, ".SH" or ".SS".
std::string OptionGroups(const CLI::App& app, const std::string& heading) {
  std::string text;
  const auto add = [&](const std::string& name, const Options& options) {
    if (!options.empty()) absl::StrAppend(&text, heading, " \"", Escaped(name), "\"\n", Terms(options));
  };
  add("Arguments", OptionsOf(app, "", true));
  for (const std::string& group : app.get_groups())
    if (!group.empty()) add(group, OptionsOf(app, group, false));
  return text;
}

std::string Usage(const CLI::App& app) {
  std::string text = absl::StrCat(Bold(FullName(app)), " [\\fIOPTIONS\\fR]");
  for (const CLI::Option* option : OptionsOf(app, "", true)) {
    const std::string name = absl::StrCat("\\fI", Escaped(option->get_name(true)), "\\fR");
    absl::StrAppend(&text, " ", option->get_required() ? name : absl::StrCat("[", name, "]"));
  }
  return text + "\n";
}

std::string Command(const CLI::App& command) {
  return absl::StrCat(".SH \"", Escaped(FullName(command)), "\"\n", Usage(command), ".PP\n",
                      Troff(command.get_description()), OptionGroups(command, ".SS"), ".SS Notes\n",
                      Troff(command.get_footer()));
}

Commands CommandsOf(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> Names(const Commands& commands) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands) names.push_back(command->get_name());
  return names;
}

// The words that an option takes: "gps|utc" stands for them in its help, as capitals do for any value.
std::string WordsOf(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::string words = type.substr(0, type.find(':'));
  return std::ranges::any_of(words, absl::ascii_isupper) ? "" : absl::StrReplaceAll(words, {{"|", " "}});
}

// The cases of `app` in the script: by the flag before the cursor, the words that may follow it.
std::string Cases(const CLI::App& app, const std::string& command) {
  std::map<std::string, std::vector<std::string>> flags_by_words;
  std::vector<std::string> flags;
  for (const CLI::Option* option : app.get_options(IsListed)) {
    for (const std::string& name : option->get_lnames()) {
      flags.push_back("--" + name);
      if (option->get_items_expected_max() > 0)
        flags_by_words[WordsOf(*option)].push_back(absl::StrCat(command, "/--", name));
    }
  }
  std::string text;
  for (const auto& [words, names] : flags_by_words)
    absl::StrAppend(&text, "    ", absl::StrJoin(names, " | "), ") words='", words, "' ;;\n");
  const std::string others = absl::StrJoin(Names(CommandsOf(app)), " ");
  absl::StrAppend(&text, "    ", command, "/*) [[ $current == -* ]] && words='", absl::StrJoin(flags, " "),
                  "' || words='", others, "' ;;\n");
  return text;
}

}  // namespace

std::string Troff(const std::string& text) {
  std::string troff;
  bool is_indented = false;
  for (const std::string& line : Lines(text)) {
    const bool indents = line.starts_with(" ");
    if (indents != is_indented) troff += indents ? ".PP\n.nf\n" : ".fi\n";
    is_indented = indents;
    troff += line.empty() ? ".PP\n" : Line(std::string(absl::StripLeadingAsciiWhitespace(line)));
  }
  return troff + (is_indented ? ".fi\n" : "");
}

std::string ManualHead(const std::string& name, const std::string& section, const std::string& version,
                       const std::string& about) {
  return absl::StrCat(".TH ", Escaped(absl::AsciiStrToUpper(name)), " ", section, " \"\" \"albtpu ", version,
                      "\" albtpu\n.nh\n.ad l\n.SH NAME\n", Escaped(name), " \\- ", Escaped(about), "\n");
}

std::string ManualPage(const CLI::App& program, const std::string& section, const std::string& version) {
  const Commands commands = CommandsOf(program);
  std::string page = ManualHead(program.get_name(), section, version, program.get_description());
  absl::StrAppend(&page, ".SH SYNOPSIS\n", commands.empty() ? Usage(program) : "");
  for (const CLI::App* command : commands)
    absl::StrAppend(&page, command == commands[0] ? "" : ".br\n", Usage(*command));
  absl::StrAppend(&page, ".SH DESCRIPTION\n", Troff(program.get_footer()), OptionGroups(program, ".SH"));
  for (const CLI::App* command : commands) page += Command(*command);
  return absl::StrCat(page,
                      ".SH SEE ALSO\n\\fBalbtpu\\-query\\fR(1), \\fBalbtpu\\-generate\\fR(1),\n"
                      "\\fBalbtpu\\-survey\\fR(5), \\fBalbtpu\\-serve\\fR(8), /usr/share/doc/albtpu");
}

std::string BashCompletion(const CLI::App& program) {
  const Commands commands = CommandsOf(program);
  const std::string function = absl::StrCat("_", absl::StrReplaceAll(program.get_name(), {{"-", "_"}}));
  std::string script = absl::StrCat("# Made by ", program.get_name(), " --bash-completion.\n", function, "() {\n");
  absl::StrAppend(
      &script,
      R"(  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command='' words='' word
  [[ $previous != = ]] || previous=${COMP_WORDS[COMP_CWORD - 2]}
  [[ $current != = ]] || current=''
  for word in "${COMP_WORDS[@]:1:COMP_CWORD - 1}"; do
    [[ ' )",
      absl::StrJoin(Names(commands), " "), R"( ' != *" $word "* ]] || { command=$word && break; }
  done
  case $command/$previous in
)");
  for (const CLI::App* command : commands) script += Cases(*command, command->get_name());
  return absl::StrCat(script, Cases(program, ""), R"(  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}
complete -o bashdefault -o default -F )",
                      function, " ", program.get_name());
}

void AddManualFlags(CLI::App& program, const std::string& version) {
  const auto print = [](const std::string& text) { throw CLI::CallForVersion(text, 0); };
  program
      .add_option_function<std::string>(
          "--man-page",
          [&program, print, version](const std::string& section) { print(ManualPage(program, section, version)); })
      ->group("");
  program.add_flag_callback("--bash-completion", [&program, print] { print(BashCompletion(program)); })->group("");
}

}  // namespace albtpu::programs
