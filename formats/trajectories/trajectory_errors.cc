#include "formats/trajectories/trajectory_errors.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "formats/files/file_access.h"
#include "formats/text/text.h"
#include "formats/trajectories/ascii_trajectory.h"
#include "formats/trajectories/trajectory_files.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLookedAt = 4096;  // Bytes, by which a file is recognized.

bool IsNamedAsErrors(const fs::path& path) {
  const std::string name = absl::AsciiStrToLower(path.filename().string());
  return absl::StrContains(name, "smrmsg") || absl::StrContains(name, "rms");
}

bool IsSmrmsg(const fs::path& path) {
  const absl::StatusOr<MappedFile> file = MappedFile::Open(path, "an SMRMSG");
  if (!file.ok()) return false;
  const std::string_view beginning = file->bytes().substr(0, kLookedAt);
  return !AsciiTrajectory::Recognizes(beginning) && SmrmsgFile::Recognizes(beginning);
}

absl::Status AddFolder(const std::string& path, TrajectoryErrors::Files& errors, std::vector<std::string>& skipped) {
  ASSIGN_OR_RETURN(const std::vector<fs::path> files, FilesAt(path));
  std::vector<std::string> others;
  const std::size_t before = errors.size();
  for (const fs::path& file : files) {
    const bool is_named = IsNamedAsErrors(file);
    if (!IsSmrmsg(file) && (!is_named || OpenTrajectory(file).ok())) {
      if (is_named) others.push_back(file.filename().string());
      continue;
    }
    ASSIGN_OR_RETURN(SmrmsgFile smrmsg, SmrmsgFile::Open(file));
    errors.push_back(std::make_shared<const SmrmsgFile>(std::move(smrmsg)));
  }
  if (!others.empty()) {
    skipped.push_back(
        absl::StrCat(path, ": skipped ", absl::StrJoin(others, ", "), " (trajectories by their contents)"));
  }
  if (errors.size() > before) return absl::OkStatus();
  return absl::NotFoundError(absl::StrCat(
      path, ": no error file in this folder (no file is an SMRMSG by its contents", others.empty() ? "" : "; ",
      absl::StrJoin(others, ", "), others.empty() ? "" : ": trajectories by their contents", "); name the files"));
}

TimeSpan SpanOf(const SmrmsgFile& file) { return {file.TimeAt(0), file.TimeAt(file.size() - 1)}; }

// Whether two files state other errors at the same times, as those of other flights do. Solutions of one flight that
// was processed twice, or in parts, differ by less.
bool Contradict(const SmrmsgFile& a, const SmrmsgFile& b, const TimeSpan& during) {
  constexpr double kMost = 1.5;
  constexpr int kTimes = 20;
  const double first = std::max({SpanOf(a).first, SpanOf(b).first, during.first});
  const double last = std::min({SpanOf(a).last, SpanOf(b).last, during.last});
  // Those of other weeks cover the same hours; parts of one flight have little in common.
  const auto length = [](const SmrmsgFile& file) { return SpanOf(file).last - SpanOf(file).first; };
  if (Overlap(SpanOf(a), SpanOf(b)) < 0.5 * std::min(length(a), length(b))) return false;
  const auto differ = [](double one, double other) { return one > kMost * other || other > kMost * one; };
  for (int i = 0; first <= last && i <= kTimes; ++i) {
    const double time = first + (last - first) * i / kTimes;
    const std::optional<TrajectorySigma> of_a = a.SigmaAt(time), of_b = b.SigmaAt(time);
    if (!of_a.has_value() || !of_b.has_value()) continue;
    if (differ(std::hypot(of_a->north, of_a->east), std::hypot(of_b->north, of_b->east)) ||
        differ(of_a->down, of_b->down) || differ(of_a->heading, of_b->heading))
      return true;
  }
  return false;
}

// Two files that contradict each other; none do where `first` is the end.
std::pair<std::size_t, std::size_t> FindContradiction(const TrajectoryErrors::Files& files, const TimeSpan& during) {
  for (std::size_t i = 0; i < files.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (Contradict(*files[j], *files[i], during)) return {j, i};
  return {files.size(), files.size()};
}

}  // namespace

absl::StatusOr<TrajectoryErrors> LoadTrajectoryErrors(std::span<const std::string> paths) {
  TrajectoryErrors::Files errors;
  std::vector<std::string> skipped;
  for (const std::string& path : paths) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) {
      RETURN_IF_ERROR(AddFolder(path, errors, skipped));
      continue;
    }
    ASSIGN_OR_RETURN(SmrmsgFile smrmsg, SmrmsgFile::Open(path));
    errors.push_back(std::make_shared<const SmrmsgFile>(std::move(smrmsg)));
  }
  return TrajectoryErrors(std::move(errors), std::move(skipped));
}

TrajectoryErrors::TrajectoryErrors(Files files, std::vector<std::string> skipped)
    : files_(std::move(files)), skipped_(std::move(skipped)) {
  std::vector<TimeSpan> spans;
  spans.reserve(files_.size());
  for (const auto& file : files_) spans.push_back(SpanOf(*file));
  spans_ = SpanIndex(spans);
}

std::optional<TrajectorySigma> ErrorsOfRun::SigmaAt(double time) const {
  for (const std::shared_ptr<const SmrmsgFile>& file : files)
    if (std::optional<TrajectorySigma> sigma = file->SigmaAt(time); sigma.has_value()) return sigma;
  return std::nullopt;
}

absl::StatusOr<ErrorsOfRun> TrajectoryErrors::Of(const TimelineRun& run, const TimeSpan& points) const {
  const TimeSpan whole = {run.span().first - run.offset, run.span().last - run.offset};
  std::vector<std::size_t> found;
  spans_.Find(whole, found);
  std::sort(found.begin(), found.end());
  ErrorsOfRun errors;
  for (const std::size_t i : found) errors.files.push_back(files_[i]);
  TimeSpan during = {std::max(whole.first, points.first - run.offset), std::min(whole.last, points.last - run.offset)};
  if (during.first > during.last) during = whole;
  const auto [one, other] = FindContradiction(errors.files, during);
  if (one == errors.files.size()) return errors;
  const Trajectory& trajectory = *run.trajectory;
  ErrorsOfRun own;
  for (const std::shared_ptr<const SmrmsgFile>& file : errors.files) {
    const bool same = std::abs(SpanOf(*file).first - trajectory.TimeAt(0)) <= kSameFlight &&
                      std::abs(SpanOf(*file).last - trajectory.TimeAt(trajectory.size() - 1)) <= kSameFlight;
    if (same)
      own.files.push_back(file);
    else
      own.left_out.push_back(file->name());
  }
  if (!own.files.empty() && FindContradiction(own.files, during).first == own.files.size()) return own;
  return absl::FailedPreconditionError(
      absl::StrCat(errors.files[one]->name(), " and ", errors.files[other]->name(),
                   " state other errors for the same seconds of a week, which they do not name, and ",
                   own.files.empty() ? "neither begins and ends" : "both begin and end", " with ", trajectory.name(),
                   "; give only that of this flight by --trajectory-errors"));
}

absl::StatusOr<std::vector<ErrorsOfRun>> TrajectoryErrors::Of(const TrajectoryTimeline& timeline) const {
  std::vector<ErrorsOfRun> errors;
  for (const TimelineRun& run : timeline.runs()) {
    ASSIGN_OR_RETURN(ErrorsOfRun of_run, Of(run, timeline.points().span));
    errors.push_back(std::move(of_run));
  }
  return errors;
}

}  // namespace albtpu::formats
