#include "formats/trajectories/trajectory_set.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "formats/trajectories/open_trajectory.h"

namespace albtpu::formats {
namespace {

namespace fs = std::filesystem;

constexpr std::array kExtensions = {".sbet", ".sbt", ".out", ".trj", ".txt", ".csv"};
constexpr std::array kOtherContents = {"smrmsg", "rms", "report"};

bool MayBeTrajectory(const fs::path& path) {
  const std::string extension = absl::AsciiStrToLower(path.extension().string());
  const std::string stem = absl::AsciiStrToLower(path.stem().string());
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end() &&
         std::none_of(kOtherContents.begin(), kOtherContents.end(),
                      [&](const char* word) { return absl::StrContains(stem, word); });
}

absl::StatusOr<std::vector<fs::path>> FilesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    if (entry->is_regular_file(ignored) && MayBeTrajectory(entry->path())) files.push_back(entry->path());
  }
  if (error) {
    return absl::FailedPreconditionError(
        absl::StrCat(folder.string(), ": ", error.message(), "; give a folder that can be read"));
  }
  if (files.empty()) {
    return absl::NotFoundError(absl::StrCat(folder.string(),
                                            ": no trajectory in this folder (no file with the extension "
                                            ".sbet, .sbt, .out, .trj, .txt or .csv other than "
                                            "error files and reports; subfolders were not searched); give a "
                                            "folder that has some, or name the files"));
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

absl::StatusOr<TrajectoryFiles> LoadTrajectories(std::span<const std::string> paths) {
  TrajectoryFiles trajectories;
  for (const std::string& path : paths) {
    std::error_code ignored;
    absl::StatusOr<std::vector<fs::path>> files = std::vector<fs::path>{path};
    if (fs::is_directory(path, ignored)) files = FilesIn(path);
    if (!files.ok()) return files.status();
    for (const fs::path& file : *files) {
      absl::StatusOr<std::unique_ptr<Trajectory>> trajectory = OpenTrajectory(file);
      if (!trajectory.ok()) return trajectory.status();
      trajectories.push_back(*std::move(trajectory));
    }
  }
  return trajectories;
}

}  // namespace albtpu::formats
