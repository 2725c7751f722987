#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "annotate/seas/sea_timeline.h"
#include "programs/command_line/command_line.h"
#include "programs/query/commands.h"
#include "programs/query/options.h"
#include "programs/query/survey_flags.h"
#include "quality/annotated/annotated_folder.h"
#include "quality/report/report_folder.h"
#include "quality/surface/survey_surface.h"
#include "status/status_macros.h"
#include "tables/file/output_folder.h"

namespace albtpu::programs {
namespace {

struct SurfaceCommandOptions {
  SurveyFlags flags;
  std::string annotated, output;
  double cell = 1;
  Existing existing = Existing::kKeep;
};

// Of a wind all is in the summaries.
constexpr std::array<std::string_view, 3> kStatedOfWinds = {"--fetch", "--wind-speed", "--wind-from"};

absl::Status RunSurface(const SurfaceCommandOptions& options) {
  ASSIGN_OR_RETURN(const config::SurveySettings settings, SettingsOf(options.flags));
  std::optional<annotate::SeaTimeline> seas;
  if (settings.sea.has_waves()) {
    ASSIGN_OR_RETURN(seas, annotate::SeaTimeline::Open(settings.sea));
  }
  ASSIGN_OR_RETURN(const std::vector<quality::AnnotatedLasFile> files, quality::OpenAnnotated(options.annotated));
  const quality::NewFolder folder(options.output);
  RETURN_IF_ERROR(PrepareFolder(options.output, options.existing));
  const HiddenFolder hidden(options.output);
  if (hidden.path().empty()) return NotWritable(options.output);
  ASSIGN_OR_RETURN(
      const annotate::JsonBox surface,
      quality::MakeSurface(files, {.cell = options.cell, .seas = seas.has_value() ? &*seas : nullptr}, hidden.path()));
  std::ofstream json(hidden.path() / "surface.json");
  json << surface->dump(2) << "\n";
  json.close();
  if (!json) return NotWritable(options.output);
  RETURN_IF_ERROR(hidden.Publish({"surface.json", "surface.nc"}));
  std::cout << options.output << "\n" << quality::SurfaceText(*surface);
  return FlushStandardOutput();
}

}  // namespace

void AddSurfaceCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<SurfaceCommandOptions>();
  CLI::App* command = program.add_subcommand(
      "surface", "The surface of a survey from its annotated files: nodes of a grid, and the uncertainty of each");
  command->add_option("OUT_DIR", options->annotated, "Folder that albtpu-query las --details wrote, or a file in it")
      ->required();
  command->add_option("--output", options->output, "Folder for surface.nc and surface.json")
      ->required()
      ->check(NotEmpty("folder"));
  command->add_option("--cell", options->cell, "Side of the cells, each of which has a node [m]")
      ->check(NumberIn(0.1, 20, "m"))
      ->capture_default_str();
  command->add_flag_callback(
      "--overwrite", [options] { options->existing = Existing::kReplace; }, "Replace an earlier surface");
  Group(*command, "How points are gathered", {"--cell"});
  Group(*command, "Output", {"--output", "--overwrite"});
  AddSeaFlags(*command, options->flags, kStatedOfWinds);
  EndHelp(*command,
          "Neighbouring pulses share waves; how much follows from the sea. Where the files were annotated with waves,\n"
          "not with a wind, give these again.",
          "annotated --output surface", "annotated --output surface --cell 2 --survey survey.toml");
  command->callback([options, &run] { run = [options] { return RunSurface(*options); }; });
}

}  // namespace albtpu::programs
