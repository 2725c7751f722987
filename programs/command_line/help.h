// The output of --help and --version.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "programs/command_line/cli_fwd.h"

namespace albtpu::programs {

// "albtpu-query pulse": the names of the program and of the command, if `app` is one.
std::string FullName(const CLI::App& app);

// Gives `program`, which has no command yet, --version ("NAME VERSION (COMMIT)") and a layout of --help that its
// commands inherit.
void SetUpProgram(CLI::App& program, std::string_view version, std::string_view commit);

// Lists the options of these names ("--depth") of `app` under a heading of --help.
void Group(CLI::App& app, const std::string& heading, const std::vector<std::string>& options);

// Ends the help of `app` with `notes`, which may be empty, and with two examples: what follows the name of the app, as
// "--campaign bay.toml --output bay.h5".
void EndHelp(CLI::App& app, std::string_view notes, const std::string& example,
             const std::string& another_example);

}  // namespace albtpu::programs
