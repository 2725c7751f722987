// Reads small text files given by flags: certificates, keys, tokens.
#pragma once

#include <filesystem>
#include <string>

#include "absl/status/statusor.h"

namespace albtpu {

// The content of `path`, at most 1 MiB. Error messages begin with `flag`.
absl::StatusOr<std::string> ReadTextFile(const std::string& flag, const std::filesystem::path& path);

}  // namespace albtpu
