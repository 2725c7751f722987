// Exit codes of all programs, and the error whose exit code is that of bad usage.
#pragma once

#include <string_view>

#include "absl/status/status.h"

namespace albtpu::formats {

// 0 is success.
inline constexpr int kExitFailure = 1;
inline constexpr int kExitUsage = 2;  // arguments that the program does not take

// An InvalidArgument whose cause is the command line, rather than a file or a server.
absl::Status UsageError(std::string_view message);
bool IsUsageError(const absl::Status& status);

}  // namespace albtpu::formats
