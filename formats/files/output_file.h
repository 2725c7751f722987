// The output of a command: a file that appears under its name only when it is complete.
#pragma once

#include <filesystem>

#include "absl/status/status.h"
#include "tables/file/atomic_file.h"

namespace albtpu::formats {

// FailedPrecondition when `output` and `input` are the same file, under whatever names: the input would be replaced
// while it is read.
absl::Status CheckNotTheSameFile(const std::filesystem::path& input, const std::filesystem::path& output);

}  // namespace albtpu::formats
