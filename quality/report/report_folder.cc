#include "quality/report/report_folder.h"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
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

constexpr const char* kJson = kReportFiles[0].data();
constexpr const char* kGrid = kReportFiles[1].data();
constexpr const char* kPage = kReportFiles[2].data();
constexpr const char* kPlanJson = kPlanFiles[0].data();
constexpr const char* kPlanPage = kPlanFiles[1].data();

// Writes the JSON, the last of `names`, draws the page, and gives all files their names, the page last.
absl::Status Finish(const HiddenFolder& hidden, const Json& json, std::vector<std::string> names, bool with_page,
                    const char* page, const fs::path& folder) {
  absl::Status status = WriteFileAtomically(hidden.path() / names.back(), JsonText(json), Existing::kReplace);
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
    const double value = factor["value"].get<double>();
    text += value < 0.005 ? absl::StrFormat("; no error of %s shows", name)
                          : absl::StrFormat("; factor of %s %.2f", name, value);
    if (factor["low"].is_number())
      absl::StrAppendFormat(&text, ", 95 %% interval %.2f to %.2f", factor["low"].get<double>(),
                            factor["high"].get<double>());
  }
  if (const auto& lines = check["lines"]; !lines.empty()) {
    const auto worst = std::ranges::max_element(
        lines, {}, [](const nlohmann::ordered_json& line) { return std::abs(line["z"].get<double>()); });
    double sum = 0;
    for (const auto& line : lines) sum += std::abs(line["mean_difference"].get<double>());
    const auto name = [&worst](const std::string& end) {
      const auto begin = worst->find(end + "_begin");
      return (*worst)[end].dump() +
             (begin == worst->end() ? "" : absl::StrFormat(" from %.0f s on", begin->get<double>()));
    };
    absl::StrAppendFormat(&text, "; two lines differ by %.3f m in the mean, at worst %s and %s by %.3f m, %.1f sigma",
                          sum / static_cast<double>(lines.size()), name("a"), name("b"),
                          std::abs((*worst)["mean_difference"].get<double>()), std::abs((*worst)["z"].get<double>()));
  }
  return text + ")\n";
}

std::string Percent(double fraction) { return absl::StrFormat("%.1f %%", 100 * fraction); }

// What is equally large beside the verdict: density and voids, what was assumed, datum, what a class also asks.
std::string BesideText(const Json& report) {
  std::string text;
  const Json &wanted = report["wanted"], &bottom = report["bottom"], &assumed = report["assumed"];
  if (const Json& factor = wanted["with_factor"]; !factor.is_null())
    absl::StrAppendFormat(&text, "  with the factor of the overlap (%.2f) applied to every sigma: %s\n",
                          factor["factor"].get<double>(), Percent(factor["fraction"].get<double>()));
  if (const Json& nodes = wanted["nodes"]; !nodes.is_null())
    absl::StrAppendFormat(&text, "  of the surface: %s of %d nodes of %g m\n", Percent(nodes["fraction"].get<double>()),
                          nodes["nodes"].get<std::uint64_t>(), nodes["cell"].get<double>());
  absl::StrAppendFormat(&text,
                        "  bottom: %.2f points in a m2 (spacing %.2f m); %s of the surveyed cells of %g m have none",
                        bottom["points_per_square_metre"].get<double>(), bottom["spacing"].get<double>(),
                        Percent(bottom["empty_share"].get<double>()), bottom["cell"].get<double>());
  if (const Json& largest = bottom["largest_void"]; !largest.is_null())
    absl::StrAppendFormat(&text, "; the largest void has %.0f m2 at %.1f, %.1f; %d have %.1f m2 or more",
                          largest["area"].get<double>(), largest["x"].get<double>(), largest["y"].get<double>(),
                          bottom["large_voids"].get<std::uint64_t>(), bottom["large_void_area"].get<double>());
  absl::StrAppend(&text, "\n  ");
  if (assumed.is_null())
    absl::StrAppend(&text,
                    "how much of the variance rests on assumed numbers is not known: an earlier version annotated");
  else
    absl::StrAppendFormat(&text, "assumed numbers: %s of the horizontal and %s of the vertical variance",
                          Percent(assumed["horizontal"].get<double>()), Percent(assumed["vertical"].get<double>()));
  const Json& datum = report["vertical_datum"];
  absl::StrAppend(&text, "\n  elevations: ",
                  datum.is_null() ? "vertical datum not stated; give [datum] name" : datum.get<std::string>(),
                  "; depths: below the water surface at the time of the flight\n");
  return text;
}

// By depth: both contributions and both biases.
std::string ContributionsText(const Json& contributions) {
  if (contributions.is_null()) return "";
  bool extra = false;
  for (const Json& band : contributions) {
    for (const char* const axis : {"sigma_horizontal", "sigma_vertical"})
      extra = extra || band[axis]["extra"].get<double>() > 0;
  }
  std::string text = absl::StrFormat("  %9s %9s | %-*s | %-*s | %s\n", "depth", "points", extra ? 30 : 23,
                                     "horizontal, m, 1 sigma", extra ? 37 : 30, "vertical, m, 1 sigma", "mean bias, m");
  absl::StrAppendFormat(&text,
                        "  %9s %9s | sensor   sea water%s  total | sensor   sea water datum%s  total | along     up\n",
                        "m", "", extra ? "  extra" : "", extra ? "  extra" : "");
  for (const Json& band : contributions) {
    const std::string to = band["to"].is_number() ? absl::StrFormat("%g", band["to"].get<double>()) : "";
    absl::StrAppendFormat(&text, "  %9s %9.0f", absl::StrFormat("%g - %s", band["from"].get<double>(), to),
                          band["points"].get<double>());
    for (const char* const axis : {"sigma_horizontal", "sigma_vertical"}) {
      const Json& sigma = band[axis];
      const auto of = [&](const char* name) { return sigma[name].get<double>(); };
      absl::StrAppendFormat(&text, " |  %5.3f %5.3f %5.3f", of("air"), of("sea"), of("water"));
      if (std::string_view(axis) == "sigma_vertical") absl::StrAppendFormat(&text, " %5.3f", of("datum"));
      if (extra) absl::StrAppendFormat(&text, "  %5.3f", of("extra"));
      absl::StrAppendFormat(&text, "  %5.3f", of("total"));
    }
    absl::StrAppendFormat(&text, " | %+6.3f %+6.3f\n", band["bias_along_beam"].get<double>(),
                          band["bias_vertical"].get<double>());
  }
  return text;
}

// What the wanted class also asks; empty if nothing is known.
std::string AlsoOf(const Json& report) {
  for (const Json& specification : report["specifications"])
    for (const Json& of : specification["classes"])
      if (of["index"] == report["wanted"]["index"] && of["also"].is_string()) return of["also"].get<std::string>();
  return "";
}

}  // namespace

std::string JsonText(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

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
  malloc_trim(0);  // Another process draws the page while this one waits.
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
  const auto &wanted = report["wanted"], &check = report["crosscheck"];
  const auto points = wanted["points"].get<std::uint64_t>(), numbers = wanted["with_number"].get<std::uint64_t>();
  std::string text = absl::StrFormat(
      "%s %s: THU and TVU %s %.2f %% of %d points (at least %g %% required)%s\n",
      wanted["specification"].get<std::string>(), wanted["class"].get<std::string>(),
      wanted["passes"].get<bool>() ? "are within the limits at" : "are NOT within the limits: at",
      100 * wanted["fraction"].get<double>(), points, wanted["pass_share"].get<double>(),
      check.is_object() && check["agrees"] == false ? "; overlapping lines contradict the prediction" : "");
  if (numbers < points) {
    std::vector<std::string> why;
    for (const auto& [outcome, count] : wanted["without_number"].items())
      why.push_back(absl::StrCat(count.get<std::uint64_t>(), " ", outcome));
    absl::StrAppend(&text, "  ", points - numbers, " points: uncertainty not computed (", absl::StrJoin(why, ", "),
                    ")\n");
  }
  if (check.is_null())
    absl::StrAppend(&text, "  ", report["nothing_to_compare"].get<std::string>(),
                    ", so that the files cannot show whether the prediction is true\n");
  else
    absl::StrAppend(&text, "  ", OverlapText(check));
  absl::StrAppend(&text, BesideText(report));
  if (report.contains("left_out")) {
    const auto& left_out = report["left_out"];
    absl::StrAppend(&text, "  ",
                    LeftOutText({.withheld = left_out["withheld"].get<std::uint64_t>(),
                                 .noise = left_out["noise"].get<std::uint64_t>()}),
                    "\n");
  }
  if (const auto& land = report["land"]; !land.is_null()) {
    // Of each specification the first class that is met.
    std::vector<std::pair<std::string, std::string>> met;
    for (const auto& of : land["classes"]) {
      const auto specification = of["specification"].get<std::string>();
      if (met.empty() || met.back().first != specification) met.emplace_back(specification, "");
      if (met.back().second.empty() && of["met"].get<bool>()) met.back().second = of["name"].get<std::string>();
    }
    absl::StrAppendFormat(&text, "  %d dry points of land: RMSE %.3f m horizontal, %.3f m vertical",
                          land["points"].get<std::uint64_t>(), land["rmse_horizontal"].get<double>(),
                          land["rmse_vertical"].get<double>());
    for (const auto& [specification, name] : met)
      absl::StrAppend(&text, "; ", specification, " ", name.empty() ? "no class" : name);
    text += "\n";
  }
  const std::string also = AlsoOf(report);
  absl::StrAppend(&text, "  not tested by these files: ",
                  also.empty() ? "coverage, features" : absl::StrCat("what the class also asks (", also, ")"),
                  ", errors that all lines share\n");
  return text + ContributionsText(report["contributions"]);
}

}  // namespace albtpu::quality
