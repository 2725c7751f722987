#include "formats/trajectories/trajectory_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <system_error>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "formats/files/file_access.h"
#include "formats/trajectories/ascii_trajectory.h"
#include "formats/trajectories/sbet_file.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBeginning = 4096;   // Bytes. An SBET has bytes there that no text has, such as zeros.
constexpr std::size_t kHeader = 64 << 10;  // Bytes, in which a text has its first line of numbers.
constexpr std::size_t kNamed = 20;         // Skipped files whose names are listed for one reason.

constexpr double kMostWeeks = 5000;  // Of GPS: until 2075.

constexpr std::array kExtensions = {".sbet", ".sbt", ".out", ".trj", ".txt", ".csv"};
constexpr std::array kBinaryExtensions = {".sbet", ".sbt"};
constexpr std::array kOtherContents = {"smrmsg", "rms", "report"};

template <typename Words>
bool HasExtensionOf(const fs::path& path, const Words& words) {
  const std::string extension = absl::AsciiStrToLower(path.extension().string());
  return std::find(words.begin(), words.end(), extension) != words.end();
}

// The first bytes of a file, empty where it cannot be read.
std::string BeginningOf(const fs::path& path) {
  const absl::StatusOr<MappedFile> file = MappedFile::Open(path, "a trajectory");
  return file.ok() ? std::string(file->bytes().substr(0, kHeader)) : "";
}

// Why a file of a folder that could not be opened as a trajectory is none; empty where it should be one.
std::string ReasonToSkip(const fs::path& path, const absl::Status& error) {
  const std::string beginning = BeginningOf(path);
  if (AsciiTrajectory::Recognizes(beginning)) {
    if (!AsciiTrajectory::HasRecords(beginning) && !HasExtensionOf(path, kBinaryExtensions))
      return "text without the 15 or 20 columns of a trajectory";
    return "";
  }
  if (SmrmsgFile::Recognizes(beginning)) return "error files (SMRMSG), which are given by --trajectory-errors";
  const std::string stem = absl::AsciiStrToLower(path.stem().string());
  const bool is_named_otherwise = std::any_of(kOtherContents.begin(), kOtherContents.end(),
                                              [&](const char* word) { return absl::StrContains(stem, word); });
  return is_named_otherwise ? absl::StrCat("no trajectory that can be read: ", error.message()) : "";
}

// The skipped files of a folder, a line for each reason.
std::vector<std::string> Lines(const std::string& folder,
                               const std::map<std::string, std::vector<std::string>>& skipped) {
  std::vector<std::string> lines;
  for (const auto& [reason, names] : skipped) {
    const std::size_t named = std::min(names.size(), kNamed);
    lines.push_back(absl::StrCat(
        folder, ": skipped ", absl::StrJoin(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(named), ", "),
        names.size() > named ? absl::StrCat(" and ", names.size() - named, " more") : "", " (", reason, ")"));
  }
  return lines;
}

absl::Status AddFolder(const std::string& path, VelocityAxes axes, TrajectoryFiles::Files& trajectories,
                       std::vector<std::string>& skipped) {
  ASSIGN_OR_RETURN(const std::vector<fs::path> files, FilesAt(path));
  std::map<std::string, std::vector<std::string>> reasons;
  std::size_t found = 0;
  for (const fs::path& file : files) {
    if (!HasExtensionOf(file, kExtensions)) {
      reasons["other extensions than .sbet, .sbt, .out, .trj, .txt and .csv"].push_back(file.filename().string());
      continue;
    }
    absl::StatusOr<std::unique_ptr<Trajectory>> trajectory = OpenTrajectory(file, axes);
    if (trajectory.ok()) {
      trajectories.push_back(*std::move(trajectory));
      ++found;
      continue;
    }
    const std::string reason = ReasonToSkip(file, trajectory.status());
    if (reason.empty()) return trajectory.status();
    reasons[reason].push_back(file.filename().string());
  }
  const std::vector<std::string> lines = Lines(path, reasons);
  if (found == 0) {
    return absl::NotFoundError(absl::StrCat(
        path,
        ": no trajectory in this folder (no file with the extension .sbet, .sbt, .out, .trj, .txt or "
        ".csv other than error files and reports; subfolders were not searched",
        lines.empty() ? "" : "; ", absl::StrJoin(lines, "; "), "); give a folder that has some, or name the files"));
  }
  skipped.insert(skipped.end(), lines.begin(), lines.end());
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<std::unique_ptr<Trajectory>> OpenTrajectory(const std::filesystem::path& path, VelocityAxes axes) {
  bool is_text = false;
  {
    ASSIGN_OR_RETURN(const MappedFile file, MappedFile::Open(path, "a trajectory"));
    if (IsUtf16(file.bytes()))
      return absl::InvalidArgumentError(absl::StrCat(path.string(), ": is UTF-16 text; save it as UTF-8"));
    is_text = AsciiTrajectory::Recognizes(file.bytes().substr(0, kBeginning));
  }
  if (is_text) return AsciiTrajectory::Open(path);
  return SbetFile::Open(path, axes);
}

absl::StatusOr<TrajectoryFiles> LoadTrajectories(std::span<const std::string> paths, VelocityAxes axes) {
  TrajectoryFiles::Files trajectories;
  std::vector<std::string> skipped;
  for (const std::string& path : paths) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) {
      RETURN_IF_ERROR(AddFolder(path, axes, trajectories, skipped));
      continue;
    }
    ASSIGN_OR_RETURN(std::unique_ptr<Trajectory> trajectory, OpenTrajectory(path, axes));
    trajectories.push_back(std::move(trajectory));
  }
  return TrajectoryFiles(std::move(trajectories), std::move(skipped));
}

TrajectoryFiles::TrajectoryFiles(Files files, std::vector<std::string> skipped)
    : files_(std::move(files)), skipped_(std::move(skipped)) {
  std::vector<TimeSpan> spans;
  spans.reserve(files_.size());
  for (const std::shared_ptr<const Trajectory>& file : files_)
    spans.push_back({file->TimeAt(0), file->TimeAt(file->size() - 1)});
  spans_ = SpanIndex(spans);
}

std::vector<std::size_t> TrajectoryFiles::NearTimesOf(const PointTimes& points) const {
  std::vector<std::size_t> found;
  if (spans_.empty()) return found;
  // More than GPS - UTC, and the seconds of doubtful clocks around the points.
  constexpr double kMargin = 60;
  const auto look = [&](double offset) {
    spans_.Find({points.span.first - offset - kMargin, points.span.last - offset + kMargin}, found);
  };
  if (points.form == PointTimeForm::kAdjustedStandard) {
    // Trajectories that name their week, and the weeks whose seconds others may have.
    look(0);
    look(-kAdjustedGpsOffset);
    const double first = std::floor((points.span.first + kAdjustedGpsOffset) / kSecondsPerWeek);
    const double last = std::floor((points.span.last + kAdjustedGpsOffset) / kSecondsPerWeek);
    for (const double week : {first - 1, first, last}) look(week * kSecondsPerWeek - kAdjustedGpsOffset);
  } else {
    for (const double week : {-1, 0, 1}) look(week * kSecondsPerWeek);
    // Trajectories that name their week: in each one that some of them has.
    const TimeSpan extent = spans_.extent();
    const double first = std::max(std::floor(extent.first / kSecondsPerWeek) - 1, -kMostWeeks);
    const double last = std::min(std::floor(extent.last / kSecondsPerWeek) + 1, kMostWeeks);
    for (const double zero : {0.0, std::fmod(kAdjustedGpsOffset, kSecondsPerWeek)})
      for (double week = first; week <= last; ++week) look(zero - week * kSecondsPerWeek);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace albtpu::formats
