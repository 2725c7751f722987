// Messages about arguments that a program does not take.
#pragma once

#include <string>

#include "programs/command_line/cli_fwd.h"

namespace albtpu::programs {

// One line, `PROBLEM (WHY); SUGGESTION`, about the arguments that `program` failed to parse with `error`. A command or
// an option that does not exist is named before anything that is missing, with the near match if there is one, for it
// may be what is missing, misspelt.
std::string UsageMessage(const CLI::App& program, const CLI::ParseError& error);

}  // namespace albtpu::programs
