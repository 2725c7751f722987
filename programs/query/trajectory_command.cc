#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "annotate/run/file_progress.h"
#include "formats/clocks/trajectory_time.h"
#include "formats/files/file_access.h"
#include "formats/trajectories/ascii_motion.h"
#include "formats/trajectories/ascii_trajectory.h"
#include "formats/trajectories/sbet_file.h"
#include "formats/trajectories/trajectory.h"
#include "formats/trajectories/trajectory_files.h"
#include "programs/command_line/command_line.h"
#include "programs/query/commands.h"
#include "programs/query/options.h"
#include "sea/angle.h"
#include "sea/samples.h"
#include "service/printable_text.h"
#include "status/status_macros.h"

namespace albtpu::programs {
namespace {

using Json = nlohmann::ordered_json;

// The records of a file that are further apart than a limit.
struct TimeGaps {
  std::size_t count = 0;
  double longest = 0, longest_start = 0, total = 0;  // s
};

struct TrajectorySummary {
  std::string format;  // "SBET", "ASCII" or "SMRMSG".
  std::size_t records = 0;
  double start = 0, end = 0;  // s, as Trajectory::TimeAt.
  TimeGaps gaps;
  std::optional<double> min_height, max_height;   // m above the ellipsoid.
  std::optional<double> speed;                    // m/s over ground, median.
  std::optional<formats::TrajectorySigma> sigma;  // Medians.
  // Rms difference of stated velocities from those of the positions, m/s. A file whose difference is too large is not
  // summarized but refused.
  std::optional<double> velocity_difference;
  std::string remark;  // What was repaired; without the path.

  double duration() const { return end - start; }
  // Records per second, gaps left out, unless all steps are so long.
  double rate() const {
    const double covered = duration() - gaps.total;
    if (records > gaps.count + 1 && covered > 0) return static_cast<double>(records - 1 - gaps.count) / covered;
    return duration() > 0 ? static_cast<double>(records - 1) / duration() : 0;
  }
};

// Medians are those of at most this many records, spread evenly over the file.
constexpr std::size_t kMaxSamples = 4096;

// NaN without finite values.
double MedianOfFinite(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  return values.empty() ? formats::kNotStated : Median(std::move(values));
}

TimeGaps FindGaps(std::size_t records, double longest_step, const std::function<double(std::size_t)>& time_at) {
  TimeGaps gaps;
  for (std::size_t i = 1; i < records; ++i) {
    const double step = time_at(i) - time_at(i - 1);
    if (step <= longest_step) continue;
    ++gaps.count;
    gaps.total += step;
    if (step <= gaps.longest) continue;
    gaps.longest = step;
    gaps.longest_start = time_at(i - 1);
  }
  return gaps;
}

std::optional<formats::TrajectorySigma> MedianSigma(
    std::size_t records, const std::function<std::optional<formats::TrajectorySigma>(std::size_t)>& sigma_at) {
  constexpr std::size_t kFields = formats::kSigmaFields.size();
  std::array<std::vector<double>, kFields> values;
  const std::size_t samples = std::min(records, kMaxSamples);
  for (std::size_t i = 0; i < samples; ++i) {
    const std::optional<formats::TrajectorySigma> sigma = sigma_at(i * records / samples);
    if (!sigma.has_value()) return std::nullopt;
    for (std::size_t k = 0; k < kFields; ++k) values[k].push_back((*sigma).*formats::kSigmaFields[k]);
  }
  formats::TrajectorySigma median;
  for (std::size_t k = 0; k < kFields; ++k) median.*formats::kSigmaFields[k] = MedianOfFinite(std::move(values[k]));
  return median;
}

TrajectorySummary Summarize(const formats::Trajectory& trajectory) {
  TrajectorySummary summary;
  summary.format = trajectory.format();
  summary.records = trajectory.size();
  summary.start = trajectory.TimeAt(0);
  summary.end = trajectory.TimeAt(trajectory.size() - 1);
  summary.gaps =
      FindGaps(trajectory.size(), formats::kLongestStep, [&](std::size_t i) { return trajectory.TimeAt(i); });
  double least = trajectory.Record(0).height, greatest = least;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const double height = trajectory.Record(i).height;
    least = std::min(least, height);
    greatest = std::max(greatest, height);
  }
  summary.min_height = least;
  summary.max_height = greatest;
  std::vector<double> speeds;
  for (const formats::RecordPair& pair : formats::SpreadPairs(trajectory)) {
    const formats::VelocityPair velocity =
        formats::CompareVelocities(trajectory.Record(pair.first), trajectory.Record(pair.second));
    speeds.push_back(std::hypot(velocity.north, velocity.east));
  }
  if (!speeds.empty()) summary.speed = MedianOfFinite(std::move(speeds));
  summary.sigma = MedianSigma(trajectory.size(), [&](std::size_t i) { return trajectory.SigmaAt(i); });
  summary.velocity_difference = formats::VelocityDifference(trajectory);
  summary.remark = trajectory.remark();
  const std::string path = trajectory.name() + ": ";
  if (summary.remark.starts_with(path)) summary.remark.erase(0, path.size());
  return summary;
}

TrajectorySummary Summarize(const formats::SmrmsgFile& errors) {
  TrajectorySummary summary;
  summary.format = "SMRMSG";
  summary.records = errors.size();
  summary.start = errors.TimeAt(0);
  summary.end = errors.TimeAt(errors.size() - 1);
  summary.gaps =
      FindGaps(errors.size(), formats::SmrmsgFile::kLongestGap, [&](std::size_t i) { return errors.TimeAt(i); });
  summary.sigma = MedianSigma(errors.size(), [&](std::size_t i) { return std::optional(errors.SigmaOf(i)); });
  return summary;
}

// GPS time in s since 1980, where times are not seconds of an unnamed week.
std::optional<double> GpsTimeOf(double start, double time) {
  constexpr double kLastWeekTime = formats::kSecondsPerWeek + 86400;  // A flight that began before the end of the week.
  if (start >= 0 && start <= kLastWeekTime) return std::nullopt;
  return start < formats::kAdjustedGpsOffset ? time + formats::kAdjustedGpsOffset : time;
}

std::optional<std::string> DateText(double start, double time) {
  const std::optional<double> gps = GpsTimeOf(start, time);
  return gps.has_value() && *gps >= 0 ? std::optional(formats::UtcText(*gps)) : std::nullopt;
}

// Day and time of day of seconds of the week, which begins on Sunday.
std::string WeekText(double seconds) {
  constexpr std::array kDays = {"Sunday", "Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday"};
  const auto whole = static_cast<long>(seconds);
  const long second = whole % 86400;
  return absl::StrFormat("%s %02d:%02d:%02d", kDays[static_cast<std::size_t>(whole / 86400 % 7)], second / 3600,
                         second / 60 % 60, second % 60);
}

std::string TimeText(double start, double time) {
  const std::optional<std::string> utc = DateText(start, time);
  if (utc.has_value()) return absl::StrFormat("%.3f s (%s)", time, *utc);
  if (time >= 0) return absl::StrFormat("%.3f s of the week (%s)", time, WeekText(time));
  return absl::StrFormat("%.3f s", time);
}

std::string GapText(const TrajectorySummary& summary) {
  const TimeGaps& gaps = summary.gaps;
  const double limit =
      summary.format == "SMRMSG" ? formats::SmrmsgFile::kLongestGap : std::round(formats::kLongestStep * 10) / 10;
  if (gaps.count == 0) return absl::StrFormat("none above %g s", limit);
  return absl::StrFormat("%d above %g s, the longest of %.3f s from %.3f s", gaps.count, limit, gaps.longest,
                         gaps.longest_start);
}

Json Number(std::optional<double> value) {
  if (!value.has_value() || !std::isfinite(*value)) return nullptr;
  return *value;
}

Json Degrees(double radians) { return Number(DegreesOfRadians(radians)); }

// Opens the file, whose format is detected by its content, checks it and reads all records.
absl::StatusOr<TrajectorySummary> SummarizeTrajectory(const std::filesystem::path& path) {
  bool is_smrmsg = false;
  {
    ASSIGN_OR_RETURN(const formats::MappedFile file,
                     formats::MappedFile::Open(path, "an SBET, an SMRMSG or an ASCII trajectory"));
    if (file.bytes().empty()) {
      return absl::InvalidArgumentError(
          absl::StrCat(path.string(), ": is empty; give an SBET, an SMRMSG or an ASCII trajectory"));
    }
    is_smrmsg = !formats::AsciiTrajectory::Recognizes(file.bytes()) && formats::SmrmsgFile::Recognizes(file.bytes());
  }
  if (is_smrmsg) {
    ASSIGN_OR_RETURN(const auto errors, formats::SmrmsgFile::Open(path));
    return Summarize(errors);
  }
  ASSIGN_OR_RETURN(const auto trajectory, formats::OpenTrajectory(path));
  return Summarize(*trajectory);
}

// Lines of names and values with units, below the path.
std::string TrajectoryText(const std::string& path, const TrajectorySummary& summary) {
  std::string text = PrintableText(path) + "\n";
  const auto line = [&text](const char* label, const std::string& value) {
    absl::StrAppend(&text, absl::StrFormat("  %-14s %s\n", label, value));
  };
  line("format", summary.format);
  line("records", absl::StrFormat("%d, %.4g per second", summary.records, summary.rate()));
  line("start", TimeText(summary.start, summary.start));
  line("end", TimeText(summary.start, summary.end));
  line("duration", absl::StrFormat("%.3f s", summary.duration()));
  line("gaps", GapText(summary));
  if (summary.min_height.has_value())
    line("height", absl::StrFormat("%.2f m to %.2f m above the ellipsoid", *summary.min_height, *summary.max_height));
  if (summary.speed.has_value()) line("speed", absl::StrFormat("%.1f m/s, median", *summary.speed));
  if (summary.sigma.has_value()) {
    const formats::TrajectorySigma& sigma = *summary.sigma;
    if (std::isfinite(sigma.north))
      line("sigma",
           absl::StrFormat("north %.3f m, east %.3f m, down %.3f m, medians", sigma.north, sigma.east, sigma.down));
    if (std::isfinite(sigma.roll))
      line(std::isfinite(sigma.north) ? "" : "sigma",
           absl::StrFormat("roll %.4f, pitch %.4f, heading %.4f degrees", DegreesOfRadians(sigma.roll),
                           DegreesOfRadians(sigma.pitch), DegreesOfRadians(sigma.heading)));
  }
  if (!summary.remark.empty()) line("velocities", summary.remark);
  if (summary.velocity_difference.has_value()) {
    line("velocity check", absl::StrFormat("passed: %.3f m/s rms from differences of position, at most %g m/s",
                                           *summary.velocity_difference, formats::kLargestVelocityDifference));
  } else if (summary.speed.has_value() && summary.remark.empty()) {
    line("velocity check", "none: the file states no velocities; speed and heading are those of an aircraft");
  }
  return text;
}

// The object of a file in --json: numbers in s, m, m/s and degrees, null where there is none.
Json TrajectoryJson(const std::string& path, const absl::StatusOr<TrajectorySummary>& summary) {
  Json json;
  json["file"] = PrintableText(path);
  if (!summary.ok()) {
    json["error"] = PrintableText(annotate::MessageWithDetails(summary.status()));
    return json;
  }
  json["error"] = nullptr;
  json["format"] = summary->format;
  json["records"] = summary->records;
  json["start"] = summary->start;
  json["end"] = summary->end;
  const auto utc = [&](double time) {
    const std::optional<std::string> text = DateText(summary->start, time);
    return text.has_value() ? Json(*text) : Json(nullptr);
  };
  json["start_utc"] = utc(summary->start);
  json["end_utc"] = utc(summary->end);
  json["duration"] = summary->duration();
  json["rate"] = summary->rate();
  json["gaps"] = summary->gaps.count;
  const bool gaps = summary->gaps.count > 0;
  json["longest_gap"] = gaps ? Json(summary->gaps.longest) : Json(nullptr);
  json["longest_gap_start"] = gaps ? Json(summary->gaps.longest_start) : Json(nullptr);
  json["least_height"] = Number(summary->min_height);
  json["greatest_height"] = Number(summary->max_height);
  json["speed"] = Number(summary->speed);
  const formats::TrajectorySigma sigma = summary->sigma.value_or(formats::TrajectorySigma{});
  json["sigma_north"] = Number(sigma.north);
  json["sigma_east"] = Number(sigma.east);
  json["sigma_down"] = Number(sigma.down);
  json["sigma_roll"] = Degrees(sigma.roll);
  json["sigma_pitch"] = Degrees(sigma.pitch);
  json["sigma_heading"] = Degrees(sigma.heading);
  json["velocity_difference"] = Number(summary->velocity_difference);
  json["remark"] = summary->remark.empty() ? Json(nullptr) : Json(PrintableText(summary->remark));
  return json;
}

struct TrajectoryOptions {
  std::vector<std::string> files;
  bool json = false;
};

absl::Status RunTrajectory(const TrajectoryOptions& options) {
  Json json = {{"files", Json::array()}};
  std::vector<absl::Status> failures;
  std::size_t texts = 0;
  const auto show = [&](const std::string& path, const absl::StatusOr<TrajectorySummary>& summary) {
    if (!summary.ok()) failures.push_back(summary.status());
    if (options.json)
      json["files"].push_back(TrajectoryJson(path, summary));
    else if (summary.ok())
      std::cout << (texts++ > 0 ? "\n" : "") << TrajectoryText(path, *summary);
  };
  for (const std::string& path : options.files) {
    const absl::StatusOr<std::vector<std::filesystem::path>> files = formats::FilesAt(path);
    if (!files.ok())
      show(path, files.status());
    else if (files->empty())
      show(path, absl::NotFoundError(absl::StrCat(path, ": is a folder without files; give trajectories")));
    else
      for (const std::filesystem::path& file : *files) show(file.string(), SummarizeTrajectory(file));
  }
  if (options.json) std::cout << json.dump(2) << "\n";
  RETURN_IF_ERROR(FlushStandardOutput());
  if (failures.empty()) return absl::OkStatus();
  for (std::size_t i = 0; i + 1 < failures.size(); ++i) annotate::Note(annotate::MessageWithDetails(failures[i]));
  return failures.back();
}

}  // namespace

void AddTrajectoryCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<TrajectoryOptions>();
  CLI::App* command = program.add_subcommand(
      "trajectory", "Check trajectories of aircraft (SBET, SMRMSG, ASCII) and print what they hold");
  command->add_option("files", options->files, "Trajectories and their error files, or folders of them")
      ->required()
      ->check(NotEmpty("file"))
      ->type_name("FILE");
  command
      ->add_flag("--json", options->json,
                 "Print one JSON object whose `files` has an object for each file, with null where there is "
                 "no number")
      ->group(group::kOutput);
  EndHelp(*command,
          "Prints times, records per second, gaps, heights, speed, median standard deviations, and how well "
          "stated\n"
          "velocities agree with differences of position. The format is detected by content. An ASCII\n"
          "trajectory has 15 columns: time, longitude, latitude, X, Y, Z, roll, pitch, heading, sigma X, Y, "
          "Z, sigma\n"
          "roll, pitch, heading (s, degree, m); or the 20 columns of POSPac's export.\n"
          "Exit code: 0 if every file is sound, 2 for bad usage, 1 otherwise. Sound files are shown beside "
          "others.",
          "sbet_20160511.out smrmsg_20160511.out", "trajectories/ --json");
  command->callback([options, &run] { run = [options] { return RunTrajectory(*options); }; });
}

}  // namespace albtpu::programs
