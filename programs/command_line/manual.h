// The manual page of a program and its completion for bash, made from the same options and commands as its --help.
#pragma once

#include <string>

#include "programs/command_line/cli_fwd.h"

namespace albtpu::programs {

// `text` as troff prints it. Lines that are indented stay lines of their own, in the width of a typewriter; the others
// are filled, and an empty line begins a paragraph.
std::string Troff(const std::string& text);

// How a manual page begins: its title and the section NAME. `name`: "albtpu-query"; `section`: "1"; `about`: one
// sentence without a full stop.
std::string ManualHead(const std::string& name, const std::string& section, const std::string& version,
                       const std::string& about);

// The page of `program`, whose commands and options are complete.
std::string ManualPage(const CLI::App& program, const std::string& section, const std::string& version);

// A script that completes commands, flags and their words in bash, and names of files in all other places.
std::string BashCompletion(const CLI::App& program);

// Gives `program` --man-page SECTION and --bash-completion, by which the build makes the files to install. --help does
// not list them.
void AddManualFlags(CLI::App& program, const std::string& version);

}  // namespace albtpu::programs
