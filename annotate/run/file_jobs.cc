#include "annotate/run/file_jobs.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "annotate/run/file_progress.h"
#include "formats/files/file_access.h"
#include "status/status_macros.h"
#include "tables/version.h"

namespace albtpu::annotate {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

using Extensions = std::vector<std::string>;

bool HasOneOf(const fs::path& path, const Extensions& extensions) {
  return std::ranges::any_of(extensions, [&](const std::string& each) { return HasExtension(path, each); });
}

bool IsFolder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

bool IsSame(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::equivalent(a, b, ignored);
}

// The files in `folder`, and in its subfolders with --recursive, ordered by name.
absl::StatusOr<std::vector<fs::path>> FilesIn(const fs::path& folder, const Extensions& extensions,
                                              const FileOptions& options) {
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;  // An entry that disappeared is not annotated.
    if (!formats::IsVisible(entry->path())) {
      entry.disable_recursion_pending();
    } else if (entry->is_directory(ignored)) {
      if (!options.recursive || IsSame(entry->path(), options.output_folder)) entry.disable_recursion_pending();
    } else if (entry->is_regular_file(ignored) && HasOneOf(entry->path(), extensions)) {
      files.push_back(entry->path());
    }
  }
  if (error) {
    return absl::FailedPreconditionError(
        absl::StrCat(folder.string(), ": ", error.message(), "; give a folder that can be read"));
  }
  if (files.empty()) {
    return absl::NotFoundError(
        absl::StrCat(folder.string(), ": no ", absl::StrJoin(extensions, " or "), " file in this folder",
                     options.recursive ? "" : " (subfolders were not searched)", "; give a folder that has some",
                     options.recursive ? "" : ", or add --recursive"));
  }
  std::sort(files.begin(), files.end());
  return files;
}

// The name of the output for an input of this name.
fs::path OutputName(const fs::path& name, const Extensions& extensions, const std::string& output_extension) {
  if (output_extension.empty() || HasExtension(name, output_extension)) return name;
  fs::path output = name;
  if (HasOneOf(name, extensions)) output.replace_extension();
  return output += output_extension;
}

}  // namespace

bool IsOutputMissing(const FileOptions& options) {
  return options.output_folder.empty() && (options.files.size() != 2 || IsFolder(options.files[0]));
}

std::string OutputAdvice(const std::string& extension) {
  return absl::StrCat("give IN", extension, " OUT", extension, ", or --output-dir DIR and any number of inputs");
}

absl::StatusOr<std::string> FirstInput(const Extensions& extensions, const FileOptions& options) {
  if (!IsFolder(options.files.front())) return options.files.front();
  ASSIGN_OR_RETURN(const std::vector<fs::path> inputs, FilesIn(options.files.front(), extensions, options));
  return inputs.front().string();
}

bool HasExtension(const fs::path& path, const std::string& extension) {
  return absl::AsciiStrToLower(path.extension().string()) == extension;
}

absl::StatusOr<std::vector<Job>> FindJobs(const std::string& command, const Extensions& extensions,
                                          const FileOptions& options) {
  const std::vector<std::string>& files = options.files;
  const std::string& extension = extensions.front();
  if (IsOutputMissing(options))
    return formats::UsageError(absl::StrCat(command, ": ", files.size(), " files; ", OutputAdvice(extension)));
  if (options.output_folder.empty()) return std::vector<Job>{{files[0], files[1]}};
  if (!IsFolder(options.output_folder)) {
    return absl::NotFoundError(
        absl::StrCat("--output-dir: ", options.output_folder, " is not a folder; give one that exists"));
  }
  std::vector<Job> jobs;
  std::map<fs::path, fs::path> input_of;
  const auto add = [&](const fs::path& input, const fs::path& input_name) -> absl::Status {
    const fs::path name = OutputName(input_name, extensions, options.output_extension);
    const auto [other, is_new] = input_of.emplace(name.lexically_normal(), input);
    if (!is_new)
      return formats::UsageError(
          absl::StrCat("--output-dir: two ", options.output_extension.empty() ? "inputs are" : "outputs would be",
                       " called ", name.string(), " (", other->second.string(), ", ", input.string(),
                       "); annotate them one at a time, as IN", extension, " OUT", extension));
    jobs.push_back({input, options.output_folder / name, name.has_parent_path()});
    return absl::OkStatus();
  };
  for (const std::string& file : files) {
    if (!IsFolder(file)) {
      RETURN_IF_ERROR(add(file, fs::path(file).filename()));
      continue;
    }
    ASSIGN_OR_RETURN(const std::vector<fs::path> inputs, FilesIn(file, extensions, options));
    for (const fs::path& input : inputs) RETURN_IF_ERROR(add(input, input.lexically_relative(file)));
  }
  return jobs;
}

std::uint64_t SizeOf(const fs::path& path) {
  std::error_code unknown;
  const std::uintmax_t size = fs::is_regular_file(path, unknown) ? fs::file_size(path, unknown) : 0;
  return unknown ? 0 : size;
}

namespace {

constexpr char kProgram[] = "albtpu-query";
constexpr std::uint64_t kLargestSummary = 16 << 20;  // Bytes; ours have a few thousand for each line.
constexpr int kDeepestSummary = 8;                   // Levels; ours have 4.

ordered_json TableJson(const client::TableSummary& table) {
  return {{"id", table.id}, {"version", table.version}, {"digest", table.digest}};
}

// "parameters.water_level is 0 there, 1 here" for the first value in `here` that differs in `there`; empty if none
// does.
std::string Difference(const ordered_json& there, const ordered_json& here, const std::string& name) {
  if (!here.is_object())
    return there == here ? "" : absl::StrCat(name, " is ", there.dump(), " there, ", here.dump(), " here");
  for (const auto& [key, value] : here.items()) {
    const bool is_there = there.is_object() && there.contains(key);
    const std::string inner = name.empty() ? key : absl::StrCat(name, ".", key);
    std::string difference = Difference(is_there ? there[key] : ordered_json(), value, inner);
    if (!difference.empty()) return difference;
  }
  return "";
}

}  // namespace

fs::path SummaryPath(const fs::path& output) { return fs::path(output.string() + ".json"); }

std::string SummaryText(const OutputSettings& settings, const Job& job, const Findings& findings,
                        std::uint64_t output_bytes) {
  ordered_json json;
  json["program"] = kProgram;
  json["program_version"] = std::string(Version());
  json["command"] = settings.command;
  json["parameters"] = *settings.parameters;
  json["table"] = TableJson(settings.table);
  if (const auto spectrum = settings.table.attributes.find("spectrum"); spectrum != settings.table.attributes.end())
    json["table"]["spectrum"] = spectrum->second;
  json["input"] = {{"name", job.input.filename().string()}, {"bytes", findings.input_bytes}};
  json["input"].update(*findings.input);
  json["output"] = {{"name", job.output.filename().string()}, {"bytes", output_bytes}};
  json["output"].update(*findings.output);
  if (!job.csv.empty()) json["output"]["csv"] = {{"name", job.csv.filename().string()}, {"bytes", findings.csv_bytes}};
  json["answers"] = *findings.answers;
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

absl::Status CheckComplete(const OutputSettings& settings, const Job& job) {
  const std::string output = job.output.string(), summary = SummaryPath(job.output).string();
  std::error_code error;
  if (!fs::exists(job.output, error)) return absl::NotFoundError(absl::StrCat(output, ": does not exist"));
  const auto differs = [&](const std::string& what) {
    return absl::FailedPreconditionError(absl::StrCat(output, ": already exists (", what, ")"));
  };
  const ordered_json json = ReadSummary(summary);
  if (json.empty()) return differs(absl::StrCat("without a summary ", summary, " that says how it was made"));
  ordered_json here = {{"command", settings.command},
                       {"parameters", *settings.parameters},
                       {"table", TableJson(settings.table)},
                       {"input", {{"name", job.input.filename().string()}, {"bytes", SizeOf(job.input)}}},
                       {"output", {{"bytes", SizeOf(job.output)}}}};
  if (!job.csv.empty()) here["output"]["csv"] = {{"name", job.csv.filename().string()}, {"bytes", SizeOf(job.csv)}};
  // As SummaryText writes names that are no UTF-8.
  const std::string text = here.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  const std::string difference = Difference(json, ordered_json::parse(text), "");
  if (!difference.empty()) return differs(absl::StrCat("according to its summary, ", difference));
  const fs::file_time_type made = fs::last_write_time(job.output, error);
  const auto is_newer = [&](fs::file_time_type time) { return error || time > made; };
  if (is_newer(fs::last_write_time(job.input, error))) return differs(absl::StrCat(job.input.string(), " is newer"));
  const std::optional<NewestFile>& newest = settings.newest;
  if (newest.has_value() && is_newer(newest->time)) return differs(absl::StrCat(newest->path.string(), " is newer"));
  return absl::OkStatus();
}

std::optional<NewestFile> NewestOf(const std::vector<fs::path>& files) {
  std::optional<NewestFile> newest;
  for (const fs::path& file : files) {
    std::error_code error;
    fs::file_time_type time = fs::last_write_time(file, error);
    if (error) time = fs::file_time_type::max();
    if (!newest.has_value() || time > newest->time) newest = NewestFile{file, time};
  }
  return newest;
}

ordered_json ReadSummary(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error) || SizeOf(path) > kLargestSummary) return ordered_json::object();
  std::ifstream file(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const auto is_shallow = [](int depth, ordered_json::parse_event_t, ordered_json&) {
    return depth <= kDeepestSummary;
  };
  ordered_json json = ordered_json::parse(text, is_shallow, false);
  return json.is_object() ? json : ordered_json::object();
}

ordered_json ReadAnswers(const Job& job) {
  return ReadSummary(SummaryPath(job.output)).value("answers", ordered_json());
}

absl::Status CheckSummaryCanBeWritten(const Job& job, Existing existing) {
  const fs::path summary = SummaryPath(job.output);
  std::error_code error;
  if (existing == Existing::kReplace || !fs::exists(summary, error)) return absl::OkStatus();
  // A run that was killed may leave a summary without its output; such a summary is of no use and may be replaced.
  if (!fs::exists(job.output, error) && ReadSummary(summary).value("program", ordered_json()) == kProgram)
    return absl::OkStatus();
  const fs::path& existing_file = fs::exists(job.output, error) ? job.output : summary;
  return absl::AlreadyExistsError(
      absl::StrCat(existing_file.string(), ": already exists; choose another name, or add --overwrite"));
}

absl::Status MakeRoomForSummary(const Job& job, Existing existing) {
  RETURN_IF_ERROR(CheckSummaryCanBeWritten(job, existing));
  std::error_code error;
  if (existing == Existing::kKeep) fs::remove(SummaryPath(job.output), error);
  return absl::OkStatus();
}

absl::Status CommitWithSummary(OutputFile output, const Job& job, const std::string& summary, Existing existing,
                               std::optional<OutputFile> csv) {
  const fs::path summary_path = SummaryPath(job.output);
  RETURN_IF_ERROR(CheckSummaryCanBeWritten(job, existing));
  ASSIGN_OR_RETURN(OutputFile file, OutputFile::Create(summary_path, existing));
  RETURN_IF_ERROR(output.Sync());
  if (csv.has_value()) RETURN_IF_ERROR(csv->Sync());
  RETURN_IF_ERROR(file.Write(summary));
  RETURN_IF_ERROR(file.Sync());
  std::error_code error;
  const bool new_csv = csv.has_value() && !fs::exists(job.csv, error);
  if (csv.has_value()) RETURN_IF_ERROR(csv->Commit());
  if (existing == Existing::kReplace && fs::exists(job.output, error)) {
    // The old summary goes first: if the program is killed here, no summary describes the wrong output.
    fs::remove(summary_path, error);
    RETURN_IF_ERROR(output.Commit());
    return file.Commit();
  }
  absl::Status status = file.Commit();
  if (status.ok()) {
    status = output.Commit();
    if (!status.ok()) fs::remove(summary_path, error);
  }  // Else the summary may be that of another process, which has written the same output.
  if (!status.ok() && new_csv) fs::remove(job.csv, error);
  return status;
}

}  // namespace albtpu::annotate
