#include "annotate/run/summary_file.h"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>

#include "absl/strings/str_cat.h"
#include "tables/version.h"

namespace albtpu::annotate {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr char kProgram[] = "albtpu-query";
constexpr std::uint64_t kLargestSummary = 16 << 20;  // Bytes; ours have a few thousand for each line.
constexpr int kDeepestSummary = 8;                   // Levels; ours have 4.

Json TableJson(const client::TableSummary& table) {
  return {{"id", table.id}, {"version", table.version}, {"digest", table.digest}};
}

std::uint64_t SizeOf(const fs::path& path) {
  std::error_code ignored;
  const std::uintmax_t size = fs::file_size(path, ignored);
  return ignored ? 0 : size;
}

// "parameters.water_level is 0 there, 1 here" for the first value in `here` that differs in `there`; empty if none
// does.
std::string Difference(const Json& there, const Json& here, const std::string& name) {
  if (!here.is_object()) {
    return there == here ? "" : absl::StrCat(name, " is ", there.dump(), " there, ", here.dump(), " here");
  }
  for (const auto& [key, value] : here.items()) {
    const bool is_there = there.is_object() && there.contains(key);
    const std::string inner = name.empty() ? key : absl::StrCat(name, ".", key);
    std::string difference = Difference(is_there ? there[key] : Json(), value, inner);
    if (!difference.empty()) return difference;
  }
  return "";
}

}  // namespace

fs::path SummaryPath(const fs::path& output) { return fs::path(output.string() + ".json"); }

std::string SummaryText(const OutputSettings& settings, const Job& job, const Findings& findings,
                        std::uint64_t output_bytes) {
  Json json;
  json["program"] = kProgram;
  json["program_version"] = std::string(Version());
  json["command"] = settings.command;
  json["parameters"] = *settings.parameters;
  json["table"] = TableJson(settings.table);
  json["input"] = {{"name", job.input.filename().string()}, {"bytes", findings.input_bytes}};
  json["input"].update(*findings.input);
  json["output"] = {{"name", job.output.filename().string()}, {"bytes", output_bytes}};
  json["output"].update(*findings.output);
  json["answers"] = *findings.answers;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

absl::Status CheckComplete(const OutputSettings& settings, const Job& job) {
  const std::string output = job.output.string(), summary = SummaryPath(job.output).string();
  std::error_code error;
  if (!fs::exists(job.output, error)) return absl::NotFoundError(absl::StrCat(output, ": does not exist"));
  const auto differs = [&](const std::string& what) {
    return absl::FailedPreconditionError(absl::StrCat(output, ": already exists (", what, ")"));
  };
  const Json json = ReadSummary(summary);
  if (json.empty()) return differs(absl::StrCat("without a summary ", summary, " that says how it was made"));
  const Json here = {{"command", settings.command},
                     {"parameters", *settings.parameters},
                     {"table", TableJson(settings.table)},
                     {"input", {{"name", job.input.filename().string()}, {"bytes", SizeOf(job.input)}}},
                     {"output", {{"bytes", SizeOf(job.output)}}}};
  const std::string difference = Difference(json, here, "");
  if (!difference.empty()) return differs(absl::StrCat("according to its summary, ", difference));
  std::vector<fs::path> read = {job.input};
  read.insert(read.end(), settings.files.begin(), settings.files.end());
  for (const fs::path& file : read) {
    if (fs::last_write_time(file, error) > fs::last_write_time(job.output, error) || error) {
      return differs(absl::StrCat(file.string(), " is newer"));
    }
  }
  return absl::OkStatus();
}

Json ReadSummary(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error) || SizeOf(path) > kLargestSummary) return Json::object();
  std::ifstream file(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const auto is_shallow = [](int depth, Json::parse_event_t, Json&) { return depth <= kDeepestSummary; };
  Json json = Json::parse(text, is_shallow, false);
  return json.is_object() ? json : Json::object();
}

Json ReadAnswers(const Job& job) { return ReadSummary(SummaryPath(job.output)).value("answers", Json()); }

absl::Status CheckSummaryCanBeWritten(const Job& job, Existing existing) {
  const fs::path summary = SummaryPath(job.output);
  std::error_code error;
  if (existing == Existing::kReplace || !fs::exists(summary, error)) return absl::OkStatus();
  // A run that was killed may leave a summary without its output; such a summary is of no use and may be replaced.
  if (!fs::exists(job.output, error) && ReadSummary(summary).value("program", Json()) == kProgram) {
    return absl::OkStatus();
  }
  const fs::path& existing_file = fs::exists(job.output, error) ? job.output : summary;
  return absl::AlreadyExistsError(
      absl::StrCat(existing_file.string(), ": already exists; choose another name, or add --overwrite"));
}

absl::Status CommitWithSummary(OutputFile output, const Job& job, const std::string& summary,
                               Existing existing) {
  const fs::path summary_path = SummaryPath(job.output);
  if (absl::Status status = CheckSummaryCanBeWritten(job, existing); !status.ok()) return status;
  absl::StatusOr<OutputFile> file = OutputFile::Create(summary_path, Existing::kReplace);
  if (!file.ok()) return file.status();
  absl::Status status = output.Sync();
  if (status.ok()) status = file->Write(summary);
  if (status.ok()) status = file->Sync();
  if (!status.ok()) return status;
  std::error_code error;
  if (fs::exists(job.output, error)) {
    // The old summary goes first: if the program is killed here, no summary describes the wrong output.
    fs::remove(summary_path, error);
    status = output.Commit();
    return status.ok() ? file->Commit() : status;
  }
  status = file->Commit();
  if (status.ok()) status = output.Commit();
  if (!status.ok()) fs::remove(summary_path, error);
  return status;
}

}  // namespace albtpu::annotate
