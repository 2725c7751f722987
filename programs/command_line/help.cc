#include "programs/command_line/help.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"

namespace albtpu::programs {
namespace {

// CLI11's own layout with one empty line, not two, between groups of options.
class Layout : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    return absl::StrReplaceAll(CLI::Formatter::make_help(app, std::move(name), mode), {{"\n\n\n", "\n\n"}});
  }
};

}  // namespace

std::string FullName(const CLI::App& app) {
  const CLI::App* parent = app.get_parent();
  return parent == nullptr ? app.get_name() : absl::StrCat(FullName(*parent), " ", app.get_name());
}

void SetUpProgram(CLI::App& program, std::string_view version, std::string_view commit) {
  program.formatter(std::make_shared<Layout>());
  program.set_version_flag("--version", absl::StrCat(program.get_name(), " ", std::string(version), " (",
                                                     std::string(commit), ")"));
}

void Group(CLI::App& app, const std::string& heading, const std::vector<std::string>& options) {
  for (const std::string& option : options) app.get_option(option)->group(heading);
}

void EndHelp(CLI::App& app, std::string_view notes, const std::string& example,
             const std::string& another_example) {
  std::string text(notes);
  absl::StrAppend(&text, notes.empty() ? "" : "\n\n", "Examples:");
  for (const std::string& arguments : {example, another_example}) {
    absl::StrAppend(&text, "\n  ", FullName(app), arguments.empty() ? "" : " ", arguments);
  }
  app.footer(text);
}

}  // namespace albtpu::programs
