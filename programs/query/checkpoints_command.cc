#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "annotate/seas/sea_timeline.h"
#include "formats/files/file_access.h"
#include "formats/text/text.h"
#include "programs/command_line/command_line.h"
#include "programs/query/commands.h"
#include "programs/query/options.h"
#include "programs/query/survey_flags.h"
#include "quality/annotated/annotated_folder.h"
#include "quality/checkpoints/point_check.h"
#include "service/printable_text.h"
#include "status/status_macros.h"
#include "tables/file/atomic_file.h"

namespace albtpu::programs {
namespace {

namespace fs = std::filesystem;

struct CheckPointsOptions {
  SurveyFlags flags;
  std::vector<std::string> inputs;  // The last one has the check points.
  std::string points;
  quality::GivenSigma sigma;
  double radius = quality::kDefaultRadius;
  bool json = false;
  Existing existing = Existing::kKeep;
};

absl::Status WritePoints(const quality::PointCheck& check, OutputFile file) {
  RETURN_IF_ERROR(file.Write(quality::PointCheckCsv(check)));
  return file.Commit();
}

absl::Status RunCheckPoints(const CheckPointsOptions& options) {
  const fs::path points = options.inputs.back();
  const std::vector<fs::path> annotated(options.inputs.begin(), options.inputs.end() - 1);
  if (annotated.empty())
    return formats::UsageError(
        "checkpoints: annotated files or check points are missing; give both, check points last");
  ASSIGN_OR_RETURN(const config::SurveySettings settings, SettingsOf(options.flags));
  std::optional<OutputFile> output;
  if (!options.points.empty()) {
    ASSIGN_OR_RETURN(const std::vector<fs::path> annotated_files, quality::FilesOfAnnotated(annotated));
    formats::FilesRead read;
    read.Add(annotated_files);
    read.Add(points);
    read.Add(FilesOf(options.flags, settings));
    RETURN_IF_ERROR(read.CheckNotReplacedBy(options.points));
    ASSIGN_OR_RETURN(output, OutputFile::Create(options.points, options.existing));
  }
  ASSIGN_OR_RETURN(const std::optional<annotate::SeaTimeline> seas, GivenSeas(options.flags, settings));
  ASSIGN_OR_RETURN(const std::vector<quality::AnnotatedLasFile> files, quality::OpenAnnotated(annotated));
  ASSIGN_OR_RETURN(const quality::PointCheck check,
                   quality::CheckPointsOf(files, points, options.sigma,
                                          {.radius = options.radius, .seas = seas.has_value() ? &*seas : nullptr}));
  if (output.has_value()) RETURN_IF_ERROR(WritePoints(check, *std::move(output)));
  std::cout << (options.json ? quality::PointCheckJson(check).dump(2) + "\n"
                             : PrintableLines(quality::PointCheckText(check)));
  return FlushStandardOutput();
}

}  // namespace

void AddCheckPointsCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<CheckPointsOptions>();
  CLI::App* command = program.add_subcommand(
      "checkpoints", "Whether check points lie on the surface of a survey as closely as its uncertainty predicts");
  command
      ->add_option("ANNOTATED", options->inputs,
                   "Folders that albtpu-query las --details wrote, or files in them; last a CSV file of check points")
      ->required();
  command
      ->add_option("--radius", options->radius,
                   "Around a check point, within which points make the surface, a plane [m]")
      ->check(NumberIn(quality::kLeastRadius, quality::kMostRadius, "m"))
      ->capture_default_str();
  command
      ->add_option("--point-sigma-horizontal", options->sigma.horizontal,
                   "Of check points without their own, one sigma, radial [m]")
      ->check(NumberIn(0, 10, "m"));
  command
      ->add_option("--point-sigma-vertical", options->sigma.vertical,
                   "Of check points without their own, one sigma [m]")
      ->check(NumberIn(0, 10, "m"));
  command->add_option("--points", options->points, "CSV file for the difference at each check point")
      ->check(NotEmpty("file"));
  command->add_flag("--json", options->json, "JSON, with every class and range of depth");
  command->add_flag_callback(
      "--overwrite", [options] { options->existing = Existing::kReplace; }, "Replace the file of --points");
  Group(*command, "How check points are compared", {"--radius", "--point-sigma-horizontal", "--point-sigma-vertical"});
  Group(*command, group::kOutput, {"--points", "--json", "--overwrite"});
  AddSeaFlags(*command, options->flags, kOfWindsAlone);
  EndHelp(
      *command,
      "POINTS.csv has the columns x, y and elevation (or easting, northing, z) in the coordinate system, the units\n"
      "and the datum of the annotated files; it may have id, class, sigma_horizontal (radial) and sigma_vertical in\n"
      "the same units. Separators and decimal marks are recognised.\n"
      "Neighbouring pulses share waves. Where the files were annotated with waves, not with a wind, give these "
      "again.\n"
      "Exit code: 0 if points were compared, whatever the conclusion is.",
      "annotated points.csv --point-sigma-vertical 0.02",
      "line1.las line2.las points.csv --radius 1 --points differences.csv --json");
  command->callback([options, &run] { run = [options] { return RunCheckPoints(*options); }; });
}

}  // namespace albtpu::programs
