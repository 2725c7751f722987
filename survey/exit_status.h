// From a status to what the shell sees: 0 when every pulse got an outcome, 2 for bad usage, 1 for failure.
#pragma once

#include <string>
#include <string_view>

#include "absl/status/status.h"

namespace albtpu::client {

inline constexpr int kExitFailure = 1;
inline constexpr int kExitUsage = 2;

// An InvalidArgument that the caller of the program made with its flags, not a file or a server.
absl::Status UsageError(std::string_view message);
bool IsUsageError(const absl::Status& status);

// Prints `albtpu-query: message` on standard error unless the status is OK; returns the exit code.
int Report(const absl::Status& status);

// Flushes standard output; fails when what was printed did not get through (a full disk, say).
absl::Status FlushAnswers();

// `albtpu-query: message` on standard error, on one line, for some of it may be a server's; then `below`,
// which is ours, as it is.
void Note(std::string_view message, const std::string& below = "");

}  // namespace albtpu::client
