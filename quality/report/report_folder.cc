#include "quality/report/report_folder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "quality/report/grid_file.h"
#include "status/status_macros.h"
#include "tables/file/atomic_file.h"

namespace albtpu::quality {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kJson = "report.json";
constexpr const char* kGrid = "grid.nc";
constexpr const char* kPage = "report.html";
constexpr const char* kPlanJson = "plan.json";
constexpr const char* kPlanPage = "plan.html";

std::string TextOf(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

// Writes the JSON, the last of `names`, draws the page, and gives all files their names, the page last.
absl::Status Finish(const HiddenFolder& hidden, const Json& json, std::vector<std::string> names, bool with_page,
                    const char* page, const fs::path& folder) {
  absl::Status status = WriteFileAtomically(hidden.path() / names.back(), TextOf(json), Existing::kReplace);
  if (status.ok() && with_page) status = DrawPage(hidden.path());
  if (with_page) names.emplace_back(page);
  if (status.ok()) status = hidden.Publish(names);
  // The page of an earlier report would show old numbers.
  std::error_code ignored;
  if (status.ok() && !with_page) fs::remove(folder / page, ignored);
  return status;
}

// What the overlap of lines says of the prediction, the conclusion first.
std::string OverlapText(const nlohmann::ordered_json& check) {
  std::string text = check["conclusion"].get<std::string>();
  absl::StrAppendFormat(&text, "\n  (%d pairs", check["pairs"].get<std::uint64_t>());
  for (const auto& [name, key] : {std::pair{"pulses", "factor_pulse"}, {"lines", "factor_line"}}) {
    const auto& factor = check[key];
    if (factor.is_null() || !factor["value"].is_number()) continue;
    absl::StrAppendFormat(&text, "; factor of %s %.2f", name, factor["value"].get<double>());
    if (factor["low"].is_number())
      absl::StrAppendFormat(&text, ", 95 %% interval %.2f to %.2f", factor["low"].get<double>(),
                            factor["high"].get<double>());
  }
  if (const auto& lines = check["lines"]; !lines.empty()) {
    const auto worst = std::ranges::max_element(
        lines, {}, [](const nlohmann::ordered_json& line) { return std::abs(line["z"].get<double>()); });
    absl::StrAppendFormat(&text, "; worst difference of two lines %.3f m, %.1f sigma",
                          std::abs((*worst)["mean_difference"].get<double>()), std::abs((*worst)["z"].get<double>()));
  }
  return text + ")\n";
}

}  // namespace

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
    RETURN_IF_ERROR(WriteGrid(grid, report.facts, hidden.path() / kGrid));
  }
  return Finish(hidden, *report.json, {kGrid, kJson}, with_page, kPage, folder);
}

absl::Status WritePlan(const Json& plan, bool with_page, const fs::path& folder) {
  const HiddenFolder hidden(folder);
  if (hidden.path().empty()) return NotWritable(folder);
  return Finish(hidden, plan, {kPlanJson}, with_page, kPlanPage, folder);
}

absl::Status CheckPageCanBeDrawn() {
  const absl::Status status = RunPython({"-c", "import matplotlib, netCDF4, numpy, albtpu.report"});
  if (status.ok()) return status;
  return absl::FailedPreconditionError(
      absl::StrCat("the page cannot be drawn (", status.message(),
                   "); install python3-matplotlib and python3-netcdf4, or albtpu[report] by pip, or leave out the page "
                   "by --no-page"));
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
  std::string text =
      absl::StrFormat("%s %s: THU and TVU %s %.2f %% of %d points (at least %g %% required)\n",
                      wanted["specification"].get<std::string>(), wanted["class"].get<std::string>(),
                      wanted["passes"].get<bool>() ? "are within the limits at" : "are NOT within the limits: at",
                      100 * wanted["fraction"].get<double>(), points, wanted["pass_share"].get<double>());
  if (numbers < points) {
    std::vector<std::string> why;
    for (const auto& [outcome, count] : wanted["without_number"].items())
      why.push_back(absl::StrCat(count.get<std::uint64_t>(), " ", outcome));
    absl::StrAppend(&text, "  ", points - numbers, " points have no number (", absl::StrJoin(why, ", "), ")\n");
  }
  if (report.contains("left_out")) {
    const auto& left_out = report["left_out"];
    absl::StrAppend(&text, "  ",
                    LeftOutText({.withheld = left_out["withheld"].get<std::uint64_t>(),
                                 .noise = left_out["noise"].get<std::uint64_t>()}),
                    "\n");
  }
  if (const auto& land = report["land"]; !land.is_null()) {
    std::string met;
    for (const auto& of : land["classes"])
      if (met.empty() && of["met"].get<bool>())
        met = absl::StrCat("; ", of["specification"].get<std::string>(), " ", of["name"].get<std::string>());
    absl::StrAppendFormat(&text, "  %d dry points of land: RMSE %.3f m horizontal, %.3f m vertical%s\n",
                          land["points"].get<std::uint64_t>(), land["rmse_horizontal"].get<double>(),
                          land["rmse_vertical"].get<double>(), met);
  }
  const auto& check = report["crosscheck"];
  if (check.is_null()) {
    return absl::StrCat(text, "  ", report["nothing_to_compare"].get<std::string>(),
                        ", so that the files cannot show whether the prediction is true\n");
  }
  absl::StrAppend(&text, "  ", OverlapText(check));
  return absl::StrCat(text, "  not tested by these files: coverage, features, errors that all lines share\n");
}

}  // namespace albtpu::quality
