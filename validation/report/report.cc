#include "validation/report/report.h"

#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "absl/strings/str_cat.h"
#include "validation/report/report_page.h"

extern char** environ;

namespace albtpu {
namespace {

constexpr const char* kPage = "report.html";

constexpr const char* kPython = "/usr/bin/python3";  // for which Debian's python3-matplotlib is installed

std::string LastLine(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string last;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

// Runs plots/draw.py with Debian's Python, which draws `figures` from the CSV files in `folder` as SVG files beside
// them. A figure that cannot be drawn is left out. Returns in one line why figures are missing; empty if none is.
std::string DrawFigures(const std::filesystem::path& plots, const std::filesystem::path& folder,
                        const std::vector<std::string>& figures) {
  if (figures.empty()) return "";
  std::vector<std::string> words = {kPython, "-B", (plots / "draw.py").string(), folder.string(),
                                    folder.string()};
  words.insert(words.end(), figures.begin(), figures.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  const std::filesystem::path messages = folder / "draw.log";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                   0600);
  pid_t child = 0;
  const int failure = posix_spawn(&child, kPython, &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) return absl::StrCat(std::strerror(failure), ": ", kPython);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const std::string said = LastLine(messages);
  std::error_code ignored;
  std::filesystem::remove(messages, ignored);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
  return said.empty() ? absl::StrCat(kPython, " failed") : said;
}

// A hidden folder inside another one, removed by the destructor.
class HiddenFolder {
 public:
  explicit HiddenFolder(const std::filesystem::path& folder) {
    std::string name = (folder / ".albtpu-XXXXXX").string();
    if (mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~HiddenFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  HiddenFolder(const HiddenFolder&) = delete;
  HiddenFolder& operator=(const HiddenFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }  // empty if it could not be created

 private:
  std::filesystem::path path_;
};

absl::Status NotWritable(const std::filesystem::path& folder) {
  return absl::PermissionDeniedError(
      absl::StrCat(folder.string(), ": the folder is not writable: ", std::strerror(errno)));
}

absl::Status WriteFile(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream out(file, std::ios::binary);
  if (!out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())) || !out.flush()) {
    return absl::DataLossError(absl::StrCat(file.string(), ": cannot be written: ", std::strerror(errno)));
  }
  return absl::OkStatus();
}

std::string Contents(const std::filesystem::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

absl::Status WriteTables(const std::vector<Study>& studies, const std::filesystem::path& folder) {
  std::vector<DataTable> tables = {SummaryOf(studies)};
  for (const Study& study : studies) tables.insert(tables.end(), study.tables.begin(), study.tables.end());
  for (const DataTable& table : tables) {
    if (const auto status = WriteFile(folder / (table.name + ".csv"), CsvOf(table)); !status.ok())
      return status;
  }
  return absl::OkStatus();
}

// Moves every file of `from` to `to`, the page last, so that a page never refers to files that do not exist yet.
absl::Status Publish(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(from)) {
    if (entry.path().filename() != kPage) files.push_back(entry.path());
  }
  files.push_back(from / kPage);
  for (const std::filesystem::path& file : files) {
    std::error_code error;
    std::filesystem::rename(file, to / file.filename(), error);
    if (error) {
      return absl::DataLossError(
          absl::StrCat((to / file.filename()).string(), ": cannot be written: ", error.message()));
    }
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status PrepareReport(const ReportOptions& options) {
  const std::filesystem::path& folder = options.folder;
  std::error_code error;
  std::filesystem::create_directory(folder, error);
  if (!std::filesystem::is_directory(folder)) {
    return absl::NotFoundError(absl::StrCat(
        folder.string(), ": cannot be created; give a folder, or a new name in an existing folder"));
  }
  if (!std::filesystem::is_empty(folder, error) && !options.overwrite) {
    return absl::AlreadyExistsError(absl::StrCat(
        folder.string(), ": is not empty; --overwrite replaces the files of an earlier report in it"));
  }
  return HiddenFolder(folder).path().empty() ? NotWritable(folder) : absl::OkStatus();
}

absl::StatusOr<std::string> WriteReport(const std::vector<Study>& studies, const ReportOptions& options) {
  const HiddenFolder hidden(options.folder);
  const std::filesystem::path& folder = hidden.path();
  if (folder.empty()) return NotWritable(options.folder);
  if (const auto status = WriteTables(studies, folder); !status.ok()) return status;

  std::vector<std::string> figures;
  for (const Study& study : studies) {
    for (const FigureRequest& figure : study.figures) figures.push_back(figure.name);
  }
  ReportPage page{options.made_by, {}, DrawFigures(options.plots, folder, figures)};
  for (const std::string& figure : figures) {
    const std::filesystem::path svg = folder / (figure + ".svg");
    if (std::filesystem::exists(svg)) {
      page.figures[figure] = Contents(svg);
    } else {  // a figure of an earlier report would not match the new numbers
      std::error_code ignored;
      std::filesystem::remove(options.folder / svg.filename(), ignored);
    }
  }
  if (const auto status = WriteFile(folder / kPage, HtmlOf(studies, page)); !status.ok()) return status;
  if (const auto status = Publish(folder, options.folder); !status.ok()) return status;
  return page.why_figures_are_missing;
}

}  // namespace albtpu
