#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "annotate/run/file_progress.h"
#include "formats/files/file_access.h"
#include "programs/command_line/command_line.h"
#include "programs/query/commands.h"
#include "programs/query/survey_flags.h"
#include "quality/annotated/annotated_folder.h"
#include "quality/crosscheck/cross_check.h"
#include "quality/report/report_folder.h"
#include "service/printable_text.h"
#include "status/status_macros.h"
#include "tables/s44.h"

namespace albtpu::programs {
namespace {

struct CrossCheckOptions {
  SurveyFlags flags;
  std::string annotated;
  double patch = quality::kDefaultPatch;
  bool json = false;
};

absl::Status RunCrossCheck(const CrossCheckOptions& options) {
  ASSIGN_OR_RETURN(const config::SurveySettings settings, SettingsOf(options.flags));
  ASSIGN_OR_RETURN(const std::optional<annotate::SeaTimeline> seas, GivenSeas(options.flags, settings));
  ASSIGN_OR_RETURN(const std::vector<quality::AnnotatedLasFile> files, quality::OpenAnnotated(options.annotated));
  ASSIGN_OR_RETURN(const quality::CrossCheck check,
                   quality::CrossCheckOf(files, options.patch, seas.has_value() ? &*seas : nullptr));
  std::cout << (options.json ? quality::CrossCheckJson(check).dump(2) + "\n"
                             : PrintableLines(quality::CrossCheckText(check)));
  return FlushStandardOutput();
}

struct ReportCommandOptions {
  SurveyFlags flags;
  std::string annotated, output, s44_order, specification, wanted_class, surface;
  double cell = 1, patch = quality::kDefaultPatch, pass_share = quality::kDefaultPassShare;
  quality::CheckPointErrors check_points;
  bool no_page = false, resume = false, json = false;
  Existing existing = Existing::kKeep;
};

// surface.json of a folder.
absl::StatusOr<annotate::JsonBox> SurfaceOf(const std::string& folder) {
  const std::filesystem::path path = std::filesystem::path(folder) / "surface.json";
  std::ifstream stream(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(text, nullptr, false);
  if (json.is_object()) return annotate::JsonBox(std::move(json));
  return absl::NotFoundError(
      absl::StrCat("--surface: ", path.string(), " cannot be read; give the folder that albtpu-query surface wrote"));
}

absl::Status TwoClasses() {
  return formats::UsageError("report: --s44-order names a class of S-44; give it alone, or --spec and --class");
}

// The flags that name the class. `wanted` is that of --spec.
absl::Status CheckAskedFor(const ReportCommandOptions& flags, const quality::Specification& wanted) {
  if (wanted.land && !flags.wanted_class.empty())
    return formats::UsageError(absl::StrCat(
        "report: --class names a class that each point of the bottom can meet, and those of ", wanted.title,
        " are root mean square errors of land; leave out --class: the report has every class with whether land meets "
        "it, and --s44-order names that of the bottom"));
  if (wanted.land || flags.s44_order.empty()) return absl::OkStatus();
  return TwoClasses();
}

// Whose verdict there is instead.
void NoteLand(const quality::Specification& of_land, const std::string& order) {
  annotate::Note(absl::StrCat(of_land.title,
                              ": its limits are root mean square errors, and are held against the points of land; the "
                              "verdict on the bottom is that of IHO S-44 ",
                              order));
}

// All installed specifications, a specification from a file of the user, and the required class.
absl::StatusOr<quality::ReportOptions> Options(const ReportCommandOptions& flags,
                                               const config::SurveySettings& survey) {
  quality::ReportOptions options{.cell = flags.cell,
                                 .specifications = {},
                                 .specification = "s44",
                                 .wanted_class = flags.s44_order.empty() ? "1b" : flags.s44_order,
                                 .pass_share = flags.pass_share,
                                 .patch = flags.patch,
                                 .check_points = flags.check_points};
  if (!flags.s44_order.empty() && !flags.wanted_class.empty()) return TwoClasses();
  const nlohmann::ordered_json project = ProjectJson(survey.project);
  for (const auto& [key, text] : project.items()) options.project.emplace_back(key, text.get<std::string>());
  options.vertical_datum = survey.datum.name.value_or("");
  if (!flags.surface.empty()) {
    ASSIGN_OR_RETURN(options.surface, SurfaceOf(flags.surface));
  }
  ASSIGN_OR_RETURN(options.specifications, quality::ListSpecifications());
  if (!flags.specification.empty()) {
    ASSIGN_OR_RETURN(quality::Specification wanted, quality::FindSpecification(flags.specification));
    const bool own = flags.specification.ends_with(".toml") || flags.specification.find('/') != std::string::npos;
    if (own && std::ranges::any_of(options.specifications,
                                   [&](const quality::Specification& each) { return each.name == wanted.name; })) {
      return absl::InvalidArgumentError(absl::StrCat(flags.specification, ": ", wanted.name,
                                                     " is the name of an installed specification; give the "
                                                     "file another name"));
    }
    RETURN_IF_ERROR(CheckAskedFor(flags, wanted));
    options.specification = wanted.land ? "s44" : wanted.name;
    if (options.specification != "s44") options.wanted_class = wanted.classes.front().name;
    if (wanted.land) NoteLand(wanted, options.wanted_class);
    std::erase_if(options.specifications, [&](const quality::Specification& each) { return each.name == wanted.name; });
    // S-44 stays first, because maps show its orders.
    options.specifications.insert(options.specifications.begin() + (wanted.name == "s44" ? 0 : 1), std::move(wanted));
  }
  if (!flags.wanted_class.empty()) options.wanted_class = flags.wanted_class;
  const std::vector<quality::Specification> of_points = quality::OfPoints(options.specifications);
  const std::size_t classes = quality::ClassCount(of_points);
  if (classes > quality::ClassJudge::kMaxClasses) {
    return absl::InvalidArgumentError(absl::StrCat("the specifications have ", classes, " classes; at most ",
                                                   quality::ClassJudge::kMaxClasses, " can be stated"));
  }
  RETURN_IF_ERROR(quality::FindClass(of_points, options.specification, options.wanted_class).status());
  return options;
}

// Where a file of the report would replace one that is read for it.
absl::Status CheckReplacesNone(const ReportCommandOptions& flags, const config::SurveySettings& survey) {
  ASSIGN_OR_RETURN(const std::vector<std::filesystem::path> annotated, quality::FilesOfAnnotated({flags.annotated}));
  formats::FilesRead read;
  read.Add(annotated);
  read.Add(FilesOf(flags.flags, survey));
  read.Add(flags.specification);
  return read.CheckNotReplacedIn(flags.output, quality::kReportFiles);
}

absl::Status RunReport(const ReportCommandOptions& flags) {
  ASSIGN_OR_RETURN(const config::SurveySettings survey, SettingsOf(flags.flags));
  RETURN_IF_ERROR(CheckReplacesNone(flags, survey));
  ASSIGN_OR_RETURN(quality::ReportOptions options, Options(flags, survey));
  ASSIGN_OR_RETURN(const std::optional<annotate::SeaTimeline> seas, GivenSeas(flags.flags, survey));
  options.seas = seas.has_value() ? &*seas : nullptr;
  if (!flags.no_page) RETURN_IF_ERROR(quality::CheckPageCanBeDrawn());
  ASSIGN_OR_RETURN(const std::vector<quality::AnnotatedLasFile> files, quality::OpenAnnotated(flags.annotated));
  if (flags.resume && quality::HasReport(flags.output, files, options, !flags.no_page)) {
    annotate::Note(absl::StrCat(flags.output, ": has the report of these files already"));
    if (flags.json) std::cout << std::ifstream(std::filesystem::path(flags.output) / "report.json").rdbuf();
    return FlushStandardOutput();
  }
  const Existing existing = flags.resume ? Existing::kReplace : flags.existing;
  const quality::NewFolder folder(flags.output);
  RETURN_IF_ERROR(PrepareFolder(flags.output, existing));
  ASSIGN_OR_RETURN(quality::SurveyReport report, quality::MakeReport(files, options));
  const std::string said = flags.json ? quality::JsonText(*report.json)
                                      : flags.output + "\n  " + PrintableLines(quality::ReportText(*report.json));
  RETURN_IF_ERROR(quality::WriteReport(std::move(report), !flags.no_page, flags.output));
  std::cout << said;
  return FlushStandardOutput();
}

}  // namespace

void AddCrossCheckCommand(CLI::App& program, std::function<absl::Status()>& run) {
  const auto options = std::make_shared<CrossCheckOptions>();
  CLI::App* command = program.add_subcommand(
      "crosscheck", "Whether the predicted uncertainty explains the differences between overlapping lines");
  command->add_option("OUT_DIR", options->annotated, "Folder that albtpu-query las --details wrote, or a file in it")
      ->required();
  command->add_option("--patch", options->patch, "Side of the patches in which lines are compared [m]")
      ->check(NumberIn(0.5, 100, "m"))
      ->capture_default_str();
  command->add_flag("--json", options->json, "JSON, with every band and every two lines");
  Group(*command, "How points are gathered", {"--patch"});
  Group(*command, "Output", {"--json"});
  AddSeaFlags(*command, options->flags, kOfWindsAlone);
  EndHelp(
      *command,
      "Lines are distinguished by the point source ID, and by pauses where it is equal.\n"
      "Neighbouring pulses share waves. Where the files were annotated with waves, not with a wind, give these again;\n"
      "otherwise pulses are taken as independent there.",
      "annotated", "annotated --patch 3 --json --survey survey.toml");
  command->callback([options, &run] { run = [options] { return RunCrossCheck(*options); }; });
}

void AddReportCommand(CLI::App& program, std::function<absl::Status()>& run) {
  const auto options = std::make_shared<ReportCommandOptions>();
  CLI::App* command =
      program.add_subcommand("report", "Whether a survey passes, from its annotated files: a page, a grid and JSON");
  command->add_option("OUT_DIR", options->annotated, "Folder that albtpu-query las --details wrote, or a file in it")
      ->required();
  command->add_option("--output", options->output, "Folder for report.html, report.json and grid.nc")
      ->required()
      ->check(NotEmpty("folder"));
  command->add_option("--cell", options->cell, "Side of the cells of the grid [m]")
      ->check(NumberIn(0.01, 10000, "m"))
      ->capture_default_str();
  command->add_option("--s44-order", options->s44_order, "Order of S-44 that was asked for (default: 1b)")
      ->check(OneOf({kS44OrderNames.begin(), kS44OrderNames.end()}));
  command
      ->add_option("--spec", options->specification,
                   "Another specification: s44, catzoc, noaa, usgs or the path of a TOML file; asprs is of land")
      ->check(NotEmpty("specification"));
  command->add_option("--class", options->wanted_class, "Class of --spec that was asked for (default: its first)");
  command->add_option("--pass", options->pass_share, "Share of the points that must meet it [%]")
      ->check(NumberIn(0, 100, "%"))
      ->capture_default_str();
  command
      ->add_option("--check-points-horizontal", options->check_points.horizontal,
                   "RMSE of the check points of land, radial [m]")
      ->check(NumberIn(0, 10, "m"))
      ->capture_default_str();
  command
      ->add_option("--check-points-vertical", options->check_points.vertical,
                   "RMSE of the check points of land [m]; their errors add to those of the points")
      ->check(NumberIn(0, 10, "m"))
      ->capture_default_str();
  command->add_option("--patch", options->patch, "Side of the patches in which overlapping lines are compared [m]")
      ->check(NumberIn(0.5, 100, "m"))
      ->capture_default_str();
  command
      ->add_option("--surface", options->surface,
                   "Folder that albtpu-query surface wrote of the same files: the verdict of its nodes, too")
      ->check(NotEmpty("folder"));
  command->add_flag("--no-page", options->no_page, "Only report.json and grid.nc, which need no Python");
  command->add_flag("--json", options->json, "Print what report.json has");
  command->add_flag("--resume", options->resume, "Do nothing if the folder has the report of these files already");
  command->add_flag_callback(
      "--overwrite", [options] { options->existing = Existing::kReplace; }, "Replace an earlier report");
  Group(*command, "What was asked for",
        {"--s44-order", "--spec", "--class", "--pass", "--check-points-horizontal", "--check-points-vertical"});
  Group(*command, "How points are gathered", {"--cell", "--patch"});
  Group(*command, "What is reported beside", {"--surface"});
  Group(*command, "Output", {"--output", "--no-page", "--json", "--resume", "--overwrite"});
  AddSeaFlags(*command, options->flags, kOfWindsAlone);
  EndHelp(*command,
          "Points without a number count as points that do not meet what was asked for.\n"
          "[project] and [datum] name of --survey stand in place of those of the annotation. Where the files were\n"
          "annotated with waves, not with a wind, overlapping lines need these again.\n"
          "Exit code: 0 if the report was made, whatever it says.",
          "annotated --output report --s44-order 1b", "annotated --output report --spec usgs --class QL2B --cell 2");
  command->callback([options, &run] { run = [options] { return RunReport(*options); }; });
}

}  // namespace albtpu::programs
