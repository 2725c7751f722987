#include "quality/report/report_folder.h"

#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "formats/files/file_access.h"
#include "quality/report/grid_file.h"
#include "tables/default_tables.h"

extern char** environ;

namespace albtpu::quality {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kJson = "report.json";
constexpr const char* kGrid = "grid.nc";
constexpr const char* kPage = "report.html";
constexpr const char* kPlanJson = "plan.json";
constexpr const char* kPlanPage = "plan.html";

// A hidden folder inside another one, removed by the destructor.
class HiddenFolder {
 public:
  explicit HiddenFolder(const fs::path& folder) {
    std::string name = (folder / ".albtpu-XXXXXX").string();
    if (mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~HiddenFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  HiddenFolder(const HiddenFolder&) = delete;
  HiddenFolder& operator=(const HiddenFolder&) = delete;

  const fs::path& path() const { return path_; }  // Empty if it could not be made.

 private:
  fs::path path_;
};

absl::Status NotWritable(const fs::path& folder) {
  return absl::PermissionDeniedError(
      absl::StrCat(folder.string(), ": cannot be written to: ", std::strerror(errno), "; give another folder"));
}

std::string TextOf(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

absl::Status Move(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (!error) return absl::OkStatus();
  return absl::DataLossError(absl::StrCat(to.string(), ": cannot be written: ", error.message()));
}

// Writes the JSON, the last of `names`, draws the page, and gives all files their names, the page last.
absl::Status Finish(const HiddenFolder& hidden, const Json& json, const std::vector<const char*>& names, bool with_page,
                    const char* page, const fs::path& folder) {
  absl::Status status = WriteFileAtomically(hidden.path() / names.back(), TextOf(json), Existing::kReplace);
  if (status.ok() && with_page) status = DrawPage(hidden.path());
  for (const char* const name : names)
    if (status.ok()) status = Move(hidden.path() / name, folder / name);
  if (status.ok() && with_page) status = Move(hidden.path() / page, folder / page);
  // The page of an earlier report would show old numbers.
  std::error_code ignored;
  if (status.ok() && !with_page) fs::remove(folder / page, ignored);
  return status;
}

}  // namespace

absl::Status PrepareFolder(const fs::path& folder, Existing existing) {
  std::error_code error;
  fs::create_directory(folder, error);
  if (!fs::is_directory(folder)) {
    return absl::NotFoundError(
        absl::StrCat(folder.string(), ": cannot be made; give a folder, or a new name in a folder that exists"));
  }
  if (!fs::is_empty(folder, error) && existing == Existing::kKeep) {
    return absl::AlreadyExistsError(absl::StrCat(
        folder.string(), ": is not empty; give another folder, or replace an earlier report by --overwrite"));
  }
  return access(folder.c_str(), W_OK) == 0 ? absl::OkStatus() : NotWritable(folder);
}

bool HasReport(const fs::path& folder, const std::vector<AnnotatedLasFile>& files, const ReportOptions& options,
               bool with_page) {
  std::ifstream stream(folder / kJson, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || json.value("made_from", Json()) != MadeFrom(files, options)) return false;
  std::error_code error;
  fs::file_time_type oldest = fs::file_time_type::max();
  for (const char* const name : {kJson, kGrid, kPage}) {
    if (name == kPage && !with_page) continue;
    oldest = std::min(oldest, fs::last_write_time(folder / name, error));
    if (error) return false;
  }
  for (const AnnotatedLasFile& file : files)
    if (fs::last_write_time(file.path(), error) > oldest || error) return false;
  return true;
}

absl::Status WriteReport(SurveyReport report, bool with_page, const fs::path& folder) {
  const HiddenFolder hidden(folder);
  if (hidden.path().empty()) return NotWritable(folder);
  {
    const SurveyGrid grid = std::move(report.grid);
    if (absl::Status status = WriteGrid(grid, report.facts, hidden.path() / kGrid); !status.ok()) return status;
  }
  return Finish(hidden, *report.json, {kGrid, kJson}, with_page, kPage, folder);
}

absl::Status WritePlan(const Json& plan, bool with_page, const fs::path& folder) {
  const HiddenFolder hidden(folder);
  if (hidden.path().empty()) return NotWritable(folder);
  return Finish(hidden, plan, {kPlanJson}, with_page, kPlanPage, folder);
}

namespace {

constexpr const char* kPython = "/usr/bin/python3";  // For which Debian's packages are installed.

// This process's environment, but for where Python finds the package and where matplotlib keeps what it caches.
std::vector<std::string> Environment() {
  std::vector<std::string> environment;
  for (char** each = environ; *each != nullptr; ++each)
    if (std::strncmp(*each, "PYTHONPATH=", 11) != 0) environment.emplace_back(*each);
  environment.push_back(absl::StrCat("PYTHONPATH=", (InstalledDataDirectory() / "python").string()));
  environment.emplace_back("MPLBACKEND=Agg");
  return environment;
}

std::vector<char*> Pointers(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

// Runs Python. The message of a failure is the last line of its standard error.
absl::Status RunPython(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {kPython, "-B"});
  std::vector<std::string> environment = Environment();
  std::array<int, 2> pipe_ends;
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0)
    return absl::InternalError(absl::StrCat("no pipe to ", kPython, ": ", std::strerror(errno)));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
  pid_t child = 0;
  const int failure =
      posix_spawn(&child, kPython, &actions, nullptr, Pointers(arguments).data(), Pointers(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  close(pipe_ends[1]);
  std::string said;
  std::array<char, 4096> bytes;
  for (ssize_t count; failure == 0 && (count = read(pipe_ends[0], bytes.data(), bytes.size())) != 0;) {
    if (count > 0) said.append(bytes.data(), static_cast<std::size_t>(count));
    if (count < 0 && errno != EINTR) break;
  }
  close(pipe_ends[0]);
  if (failure != 0) return absl::FailedPreconditionError(absl::StrCat(kPython, ": ", std::strerror(failure)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return absl::OkStatus();
  while (!said.empty() && said.back() == '\n') said.pop_back();
  const std::string last = said.substr(said.rfind('\n') + 1);
  return absl::FailedPreconditionError(last.empty() ? absl::StrCat(kPython, " failed") : last);
}

}  // namespace

absl::Status CheckPageCanBeDrawn() {
  const absl::Status status = RunPython({"-c", "import matplotlib, netCDF4, numpy, albtpu.report"});
  if (status.ok()) return status;
  return absl::FailedPreconditionError(
      absl::StrCat("the page cannot be drawn (", status.message(),
                   "); install python3-matplotlib and python3-netcdf4, or leave out the page by --no-page"));
}

absl::Status DrawPage(const std::filesystem::path& folder) {
  const absl::Status status = RunPython({"-m", "albtpu.report", folder.string()});
  if (status.ok()) return status;
  return absl::InternalError(
      absl::StrCat("the page cannot be drawn: ", status.message(), "; --no-page leaves it out, please report this"));
}

std::string ReportText(const nlohmann::ordered_json& report) {
  const auto& wanted = report["wanted"];
  const auto points = wanted["points"].get<std::uint64_t>(), numbers = wanted["with_number"].get<std::uint64_t>();
  std::string text = absl::StrFormat(
      "%s %s: %s; %.2f %% of %d points meet it (at least %g %% asked)\n", wanted["specification"].get<std::string>(),
      wanted["class"].get<std::string>(), wanted["passes"].get<bool>() ? "PASSES" : "DOES NOT PASS",
      100 * wanted["fraction"].get<double>(), points, wanted["pass_share"].get<double>());
  if (numbers < points) {
    std::vector<std::string> why;
    for (const auto& [outcome, count] : wanted["without_number"].items())
      why.push_back(absl::StrCat(count.get<std::uint64_t>(), " ", outcome));
    absl::StrAppend(&text, "  ", points - numbers, " points have no number (", absl::StrJoin(why, ", "), ")\n");
  }
  const auto& check = report["crosscheck"];
  if (check.is_null())
    return text + "  no lines overlap, so that the files cannot show whether the prediction is true\n";
  const auto& factor = check["factor"];
  absl::StrAppendFormat(&text,
                        "  %d pairs of points of overlapping lines: reduced chi-square %.2f, sigma would have to be "
                        "%.2f times as large",
                        check["pairs"].get<std::uint64_t>(), check["chi_square"].get<double>(),
                        factor["value"].get<double>());
  if (factor["low"].is_number())
    absl::StrAppendFormat(&text, " (%.2f to %.2f)", factor["low"].get<double>(), factor["high"].get<double>());
  return text + "\n";
}

}  // namespace albtpu::quality
