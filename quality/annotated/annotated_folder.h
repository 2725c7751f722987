// The annotated files of a survey.
#pragma once

#include <filesystem>
#include <vector>

#include "absl/status/statusor.h"
#include "quality/annotated/annotated_points.h"

namespace albtpu::quality {

// The annotated files in a folder by name, or the file itself, but for those without points, which are noted. All have
// the same coordinate system, unit of x and y, coverage and table. Fails with the names of the first two files that
// differ, and where no file has points.
absl::StatusOr<std::vector<AnnotatedLasFile>> OpenAnnotated(const std::filesystem::path& folder_or_file);

// The same of several folders and files, each file once, by name whatever its folder is.
absl::StatusOr<std::vector<AnnotatedLasFile>> OpenAnnotated(const std::vector<std::filesystem::path>& folders_or_files);

// The same, but none where no file has points.
absl::StatusOr<std::vector<AnnotatedLasFile>> OpenAnnotatedOrNone(
    const std::vector<std::filesystem::path>& folders_or_files);

// All files that these read there, for a check of the outputs: LAS and LAZ files and their summaries.
absl::StatusOr<std::vector<std::filesystem::path>> FilesOfAnnotated(
    const std::vector<std::filesystem::path>& folders_or_files);

}  // namespace albtpu::quality
