// A whole file or none: bytes go to a temporary name in the same folder, are synced, and take their name at
// the end.
#pragma once

#include <filesystem>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "tables/file/existing.h"

namespace albtpu {

// AlreadyExists when something is at `path` and is to be kept; InvalidArgument when it is not a regular file;
// otherwise the reason of the system. On failure nothing is left behind and `path` is as it was.
absl::Status WriteFileAtomically(const std::filesystem::path& path, absl::string_view bytes,
                                 Existing existing);

// Whether a file of this name is one of those temporary ones: what a killed writer leaves.
bool IsTemporaryName(absl::string_view name);

}  // namespace albtpu
