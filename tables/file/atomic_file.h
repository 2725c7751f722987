// Writes a whole file or none: the bytes go to a temporary name in the same folder, are synced, and get their name
// at the end.
#pragma once

#include <filesystem>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "tables/file/existing.h"

namespace albtpu {

// AlreadyExists if a file is at `path` and is to be kept; InvalidArgument if `path` is not a regular file;
// otherwise the error of the system. After a failure there is no temporary file and `path` is unchanged.
absl::Status WriteFileAtomically(const std::filesystem::path& path, absl::string_view bytes,
                                 Existing existing);

// Whether this is the name of such a temporary file, as a killed writer leaves it behind.
bool IsTemporaryName(absl::string_view name);

}  // namespace albtpu
