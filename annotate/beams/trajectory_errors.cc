#include "annotate/beams/trajectory_errors.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"

namespace albtpu::annotate {
namespace {

namespace fs = std::filesystem;

constexpr int kSamples = 200;  // Of each run of the timeline.

absl::StatusOr<std::vector<fs::path>> ErrorFilesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    const std::string name = absl::AsciiStrToLower(entry->path().filename().string());
    const bool is_named = absl::StrContains(name, "smrmsg") || absl::StrContains(name, "rms");
    if (is_named && entry->is_regular_file(ignored)) files.push_back(entry->path());
  }
  if (error) {
    return absl::FailedPreconditionError(
        absl::StrCat(folder.string(), ": ", error.message(), "; give a folder that can be read"));
  }
  if (files.empty()) {
    return absl::NotFoundError(absl::StrCat(
        folder.string(), ": no error file in this folder (no name contains smrmsg or rms); name the files"));
  }
  std::sort(files.begin(), files.end());
  return files;
}

double MedianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

absl::StatusOr<TrajectoryErrors> LoadTrajectoryErrors(std::span<const std::string> paths) {
  TrajectoryErrors errors;
  for (const std::string& path : paths) {
    std::error_code ignored;
    absl::StatusOr<std::vector<fs::path>> files = std::vector<fs::path>{path};
    if (fs::is_directory(path, ignored)) files = ErrorFilesIn(path);
    if (!files.ok()) return files.status();
    for (const fs::path& file : *files) {
      absl::StatusOr<formats::SmrmsgFile> smrmsg = formats::SmrmsgFile::Open(file);
      if (!smrmsg.ok()) return smrmsg.status();
      errors.push_back(std::make_shared<const formats::SmrmsgFile>(*std::move(smrmsg)));
    }
  }
  return errors;
}

std::optional<TrajectoryPrecision> PrecisionOf(const TrajectoryErrors& errors,
                                               const formats::TrajectoryTimeline& timeline) {
  std::vector<double> horizontal, vertical;
  for (const formats::TimelineRun& run : timeline.runs()) {
    const double first = std::max(run.span().first, timeline.points().span.first);
    const double last = std::min(run.span().last, timeline.points().span.last);
    for (int i = 0; first <= last && i < kSamples; ++i) {
      const double time = first + (last - first) * i / (kSamples - 1) - run.offset;
      for (const std::shared_ptr<const formats::SmrmsgFile>& file : errors) {
        const std::optional<formats::TrajectorySigma> sigma = file->SigmaAt(time);
        if (!sigma.has_value()) continue;
        horizontal.push_back(std::hypot(sigma->north, sigma->east));
        vertical.push_back(sigma->down);
        break;
      }
    }
  }
  if (horizontal.empty()) return std::nullopt;
  return TrajectoryPrecision{MedianOf(std::move(horizontal)), MedianOf(std::move(vertical))};
}

}  // namespace albtpu::annotate
