#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "absl/strings/str_cat.h"
#include "annotate/run/file_progress.h"
#include "programs/command_line/command_line.h"
#include "programs/query/commands.h"
#include "programs/query/options.h"
#include "programs/query/trajectory_summary.h"

namespace albtpu::programs {
namespace {

struct TrajectoryOptions {
  std::vector<std::string> files;
  bool json = false;
};

// The files of a folder, ordered by name, hidden ones left out; or the path itself.
absl::StatusOr<std::vector<std::string>> FilesOf(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) return std::vector<std::string>{path};
  std::vector<std::string> files;
  for (std::filesystem::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error))
    if (entry->is_regular_file(error) && !entry->path().filename().string().starts_with('.'))
      files.push_back(entry->path().string());
  if (error)
    return absl::UnavailableError(absl::StrCat(path, ": ", error.message(), "; give a folder that can be read"));
  if (files.empty()) return absl::NotFoundError(absl::StrCat(path, ": is a folder without files; give trajectories"));
  std::sort(files.begin(), files.end());
  return files;
}

absl::Status RunTrajectory(const TrajectoryOptions& options) {
  nlohmann::ordered_json json = {{"files", nlohmann::ordered_json::array()}};
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
    const absl::StatusOr<std::vector<std::string>> files = FilesOf(path);
    if (!files.ok()) {
      show(path, files.status());
      continue;
    }
    for (const std::string& file : *files) show(file, SummarizeTrajectory(file));
  }
  if (options.json) std::cout << json.dump(2) << "\n";
  if (absl::Status status = FlushStandardOutput(); !status.ok()) return status;
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
