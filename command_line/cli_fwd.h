// Classes of CLI11 for headers that only name them: <CLI/CLI.hpp> takes seconds to compile.
#pragma once

#include "command_line/cli_fwd.h"

namespace CLI {
class App;
class Option;
class ParseError;
class Validator;
}  // namespace CLI
