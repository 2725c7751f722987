// Checks of option values that several programs use. Each returns the problem, as CLI11 requires.
#pragma once

#include <string>
#include <vector>

#include "programs/command_line/cli_fwd.h"

namespace albtpu::programs {

// A text that is not empty, such as the name of a `what`.
CLI::Validator NotEmpty(const std::string& what);

// A whole number from `least` to `most`.
CLI::Validator WholeIn(long long least, long long most);

// A number from `least` to `most` in a `unit`: "m".
CLI::Validator NumberIn(double least, double most, const std::string& unit);

// One of `words`; a near match is named.
CLI::Validator OneOf(const std::vector<std::string>& words);

}  // namespace albtpu::programs
