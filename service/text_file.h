// Small files of text that flags name: certificates, keys, tokens.
#pragma once

#include <filesystem>
#include <string>

#include "absl/status/statusor.h"

namespace albtpu {

// The whole of `path`, at most 1 MiB. `flag` begins the message of a failure.
absl::StatusOr<std::string> ReadTextFile(const std::string& flag, const std::filesystem::path& path);

}  // namespace albtpu
