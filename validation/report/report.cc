#include "validation/report/report.h"

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "absl/strings/str_cat.h"
#include "validation/report/csv.h"
#include "validation/report/plotting.h"
#include "validation/report/report_page.h"

namespace albtpu {
namespace {

constexpr const char* kPage = "report.html";

// A hidden folder inside of another, gone when this is.
class Workshop {
 public:
  explicit Workshop(const std::filesystem::path& folder) {
    std::string name = (folder / ".albtpu-XXXXXX").string();
    if (mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~Workshop() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  const std::filesystem::path& path() const { return path_; }  // empty: could not be made

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

// Every file of `from` takes its place in `to`, the page last: a page never speaks of files that are not there.
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
        folder.string(), ": cannot be made: give a folder, or a name in a folder that is there"));
  }
  if (!std::filesystem::is_empty(folder, error) && !options.overwrite) {
    return absl::AlreadyExistsError(absl::StrCat(
        folder.string(), ": is not empty; --overwrite replaces the files of an earlier report in it"));
  }
  return Workshop(folder).path().empty() ? NotWritable(folder) : absl::OkStatus();
}

absl::StatusOr<std::string> WriteReport(const std::vector<Study>& studies, const ReportOptions& options) {
  const Workshop workshop(options.folder);
  const std::filesystem::path& folder = workshop.path();
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
    } else {  // one of an earlier report would not go with the new numbers
      std::error_code ignored;
      std::filesystem::remove(options.folder / svg.filename(), ignored);
    }
  }
  if (const auto status = WriteFile(folder / kPage, HtmlOf(studies, page)); !status.ok()) return status;
  if (const auto status = Publish(folder, options.folder); !status.ok()) return status;
  return page.why_figures_are_missing;
}

}  // namespace albtpu
