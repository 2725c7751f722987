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

namespace {

// Of the standard deviations of a whole file.
struct Range {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;  // The least of those above 0.
  bool stated = false;
};

// m or rad. A file whose greatest is below `least`, or whose least is above `greatest`, has another unit.
struct Limits {
  double least, greatest;
};
// A millimetre is the noise of a receiver's carrier phase; 5 m is beyond that of one without any correction.
constexpr Limits kPosition = {0.001, 5};
// A fifth of what the best airborne systems state after processing, 0.0025 degrees (Applanix POS AV 610), and four
// times what those of the smallest aircraft do, 0.025 degrees (Applanix APX-15 UAV).
constexpr Limits kTilt = {0.0005 * std::numbers::pi / 180, 0.1 * std::numbers::pi / 180};

struct Unit {
  const char* name;
  double size;  // m or rad; exact.
};
constexpr Unit kLengths[] = {{"millimetres", 0.001}, {"centimetres", 0.01}};
constexpr Unit kAngles[] = {{"radians", 1},
                            {"degrees", std::numbers::pi / 180},
                            {"arc minutes", std::numbers::pi / (180 * 60)},
                            {"arc seconds", std::numbers::pi / (180 * 3600)}};

// " (they may be radians)"; empty where no unit fits. `stated` is in the unit of the file.
std::string UnitsThatFit(double stated, const Limits& limits, std::span<const Unit> units) {
  std::vector<std::string> fitting;
  for (const Unit& unit : units)
    if (stated * unit.size >= limits.least && stated * unit.size <= limits.greatest) fitting.emplace_back(unit.name);
  return fitting.empty() ? "" : absl::StrCat(" (they may be ", absl::StrJoin(fitting, " or "), ")");
}

}  // namespace

absl::Status CheckSigmaUnits(const std::string& name, const SigmaColumns& columns, std::size_t size,
                             const std::function<TrajectorySigma(std::size_t)>& of_record) {
  constexpr std::size_t kFirstAngle = 6, kHeading = 8;
  std::array<Range, kSigmaFields.size()> ranges;
  for (std::size_t record = 0; record < size; ++record) {
    const TrajectorySigma sigma = of_record(record);
    for (std::size_t field = 0; field < ranges.size(); ++field) {
      const double value = sigma.*kSigmaFields[field];
      ranges[field].stated |= !std::isnan(value);
      if (value > 0) ranges[field].least = std::min(ranges[field].least, value);
      if (value > 0) ranges[field].greatest = std::max(ranges[field].greatest, value);
    }
  }
  for (const std::size_t field : {0, 1, 2, 6, 7, 8}) {
    const Range& range = ranges[field];
    const bool is_angle = field >= kFirstAngle;
    if (!range.stated) continue;
    const auto error = [&](const std::string& text) {
      return InvalidFile(name, absl::StrCat(columns.names[field], " ", text));
    };
    if (range.greatest == 0) {
      return error(
          absl::StrCat("is 0 throughout, which no trajectory has; write what it is, or, if that is not known, ",
                       columns.if_unknown));
    }
    if (field == kHeading) continue;  // On a straight course nothing tells it, and it may be large.
    const Limits& limits = is_angle ? kTilt : kPosition;
    const bool is_small = range.greatest < limits.least;
    if (!is_small && range.least <= limits.greatest) continue;
    const double stated = (is_small ? range.greatest : range.least) / (is_angle ? columns.radians : 1);
    const std::string unit = is_angle ? columns.angle : "m";
    return error(absl::StrFormat(
        "is at %s %.2g %s, %s than any navigation system of laser bathymetry has%s; convert it to %s, or, if it is not "
        "known, %s",
        is_small ? "most" : "least", stated, unit, is_small ? "less" : "more",
        UnitsThatFit(stated, limits, is_angle ? std::span<const Unit>(kAngles) : kLengths), unit, columns.if_unknown));
  }
  return absl::OkStatus();
}

}  // namespace albtpu::formats
