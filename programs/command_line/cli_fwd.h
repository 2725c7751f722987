// Classes of CLI11 for headers that only name them: <CLI/CLI.hpp> takes seconds to compile.
#pragma once

namespace CLI {
class App;
class Option;
class ParseError;
class Validator;
}  // namespace CLI
