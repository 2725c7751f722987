#include "quality/report/report_folder.h"

#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "formats/files/output_file.h"
#include "quality/report/grid_file.h"
#include "quality/report/report_page.h"

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
  return absl::PermissionDeniedError(absl::StrCat(
      folder.string(), ": cannot be written to: ", std::strerror(errno), "; give another folder"));
}

std::string TextOf(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

absl::Status Move(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (!error) return absl::OkStatus();
  return absl::DataLossError(absl::StrCat(to.string(), ": cannot be written: ", error.message()));
}

// Writes the JSON, the last of `names`, draws the page, and gives all files their names, the page last.
absl::Status Finish(const HiddenFolder& hidden, const Json& json, const std::vector<const char*>& names,
                    bool with_page, const char* page, const fs::path& folder) {
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
    return absl::NotFoundError(absl::StrCat(
        folder.string(), ": cannot be made; give a folder, or a new name in a folder that exists"));
  }
  if (!fs::is_empty(folder, error) && existing == Existing::kKeep) {
    return absl::AlreadyExistsError(absl::StrCat(
        folder.string(), ": is not empty; give another folder, or replace an earlier report by --overwrite"));
  }
  return access(folder.c_str(), W_OK) == 0 ? absl::OkStatus() : NotWritable(folder);
}

bool HasReport(const fs::path& folder, const std::vector<AnnotatedLasFile>& files,
               const ReportOptions& options, bool with_page) {
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
    if (absl::Status status = WriteGrid(grid, report.facts, hidden.path() / kGrid); !status.ok())
      return status;
  }
  return Finish(hidden, *report.json, {kGrid, kJson}, with_page, kPage, folder);
}

absl::Status WritePlan(const Json& plan, bool with_page, const fs::path& folder) {
  const HiddenFolder hidden(folder);
  if (hidden.path().empty()) return NotWritable(folder);
  return Finish(hidden, plan, {kPlanJson}, with_page, kPlanPage, folder);
}

}  // namespace albtpu::quality
