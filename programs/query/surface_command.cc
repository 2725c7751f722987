#include <CLI/CLI.hpp>
#include <algorithm>
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
#include "annotate/run/file_progress.h"
#include "annotate/seas/sea_timeline.h"
#include "formats/files/file_access.h"
#include "formats/text/text.h"
#include "programs/command_line/command_line.h"
#include "programs/query/commands.h"
#include "programs/query/options.h"
#include "programs/query/survey_flags.h"
#include "quality/annotated/annotated_folder.h"
#include "quality/report/report_folder.h"
#include "quality/surface/surface_part.h"
#include "quality/surface/surface_rasters.h"
#include "quality/surface/survey_surface.h"
#include "service/printable_text.h"
#include "status/status_macros.h"
#include "tables/file/output_folder.h"

namespace albtpu::programs {
namespace {

namespace fs = std::filesystem;

constexpr char kMerge[] = "merge";
constexpr char kSurfaceJson[] = "surface.json";
constexpr std::string_view kNetcdf = quality::kSurfaceFormatNames.front();

struct SurfaceCommandOptions {
  SurveyFlags flags;
  std::vector<std::string> inputs;  // The first one may be kMerge.
  std::string output, partial, organisation;
  std::vector<std::string> formats = {std::string(kNetcdf)};
  std::optional<double> cell;
  bool land = false;
  Existing existing = Existing::kKeep;
  bool json = false;

  bool merges() const { return inputs.front() == kMerge; }
};

constexpr double kCell = 1;  // m, where none is given.

// The words and the flags that go together.
absl::Status CheckUsage(const SurfaceCommandOptions& options) {
  const auto wrong = [](const std::string& what) { return formats::UsageError(absl::StrCat("surface: ", what)); };
  if (options.output.empty() == options.partial.empty())
    return wrong(options.output.empty() ? "--output is missing; give a folder for the surface, or --partial for a part"
                                        : "--partial has no effect with --output; leave one out");
  if (options.json && !options.partial.empty())
    return wrong("--json has no effect with --partial, which makes no surface; leave it out");
  if (!options.merges()) return absl::OkStatus();
  if (options.inputs.size() == 1) return wrong("parts are missing; give files that --partial wrote after merge");
  if (!options.partial.empty()) return wrong("--partial has no effect with merge; give --output");
  if (options.cell.has_value()) return wrong("--cell has no effect with merge, for parts have theirs; leave it out");
  if (options.land) return wrong("--land has no effect with merge, for parts have it or not; leave it out");
  if (options.flags.survey.has_value())
    return wrong("--survey has no effect with merge, for parts have their seas; leave it out");
  return absl::OkStatus();
}

std::vector<quality::SurfaceFormat> FormatsOf(const SurfaceCommandOptions& options) {
  std::vector<quality::SurfaceFormat> formats;
  for (std::size_t i = 0; i < quality::kSurfaceFormatNames.size(); ++i)
    if (std::ranges::count(options.formats, quality::kSurfaceFormatNames[i]) > 0)
      formats.push_back(static_cast<quality::SurfaceFormat>(i));
  return formats;
}

// The points of the files that are given, at `path`.
absl::StatusOr<quality::SurfacePart> Gather(const SurfaceCommandOptions& options,
                                            const config::SurveySettings& settings,
                                            const std::vector<quality::AnnotatedLasFile>& files, const fs::path& path) {
  ASSIGN_OR_RETURN(const std::optional<annotate::SeaTimeline> seas, GivenSeas(options.flags, settings));
  return quality::GatherPoints(
      files, {.cell = options.cell.value_or(kCell), .seas = seas.has_value() ? &*seas : nullptr, .land = options.land},
      path);
}

std::vector<fs::path> PathsOf(const SurfaceCommandOptions& options) {
  return {options.inputs.begin(), options.inputs.end()};
}

// The files that the command reads: parts, or annotated files with their sea.
absl::StatusOr<formats::FilesRead> FilesReadBy(const SurfaceCommandOptions& options,
                                               const config::SurveySettings& settings) {
  formats::FilesRead read;
  std::vector<fs::path> files = PathsOf(options);
  if (!options.merges()) {
    ASSIGN_OR_RETURN(files, quality::FilesOfAnnotated(files));
    read.Add(FilesOf(options.flags, settings));
  }
  read.Add(files);
  return read;
}

// But for empty ones.
absl::StatusOr<std::vector<quality::SurfacePart>> PartsOf(const SurfaceCommandOptions& options,
                                                          const std::vector<quality::SurfaceFormat>& formats) {
  std::vector<quality::SurfacePart> parts;
  for (std::size_t i = 1; i < options.inputs.size(); ++i) {
    ASSIGN_OR_RETURN(quality::SurfacePart part, quality::OpenPart(options.inputs[i]));
    if (part.empty()) continue;
    RETURN_IF_ERROR(quality::CheckFormats(formats, part.facts.map));
    parts.push_back(std::move(part));
  }
  if (parts.empty())
    return absl::FailedPreconditionError(absl::StrCat(options.inputs[1], options.inputs.size() > 2 ? " and others" : "",
                                                      ": of files without points; give a part of files with points"));
  return parts;
}

absl::Status RunPartial(const SurfaceCommandOptions& options, const config::SurveySettings& settings) {
  const fs::path path = options.partial, folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (options.existing == Existing::kKeep && fs::exists(path))
    return absl::AlreadyExistsError(
        absl::StrCat(path.string(), ": is there already; give another name, or replace it by --overwrite"));
  ASSIGN_OR_RETURN(const std::vector<quality::AnnotatedLasFile> files, quality::OpenAnnotatedOrNone(PathsOf(options)));
  const HiddenFolder hidden(folder);
  if (hidden.path().empty()) return NotWritable(folder);
  ASSIGN_OR_RETURN(const quality::SurfacePart part, Gather(options, settings, files, hidden.path() / path.filename()));
  RETURN_IF_ERROR(quality::SealPart(part));
  RETURN_IF_ERROR(hidden.Publish({path.filename().string()}));
  std::cout << path.string() << "\n  " << part.facts.with_number + part.facts.dry.value_or(0) << " points of "
            << part.facts.files.size() << " files\n";
  return FlushStandardOutput();
}

// The files of a surface, of which an earlier one may have others, replace none that is read.
absl::Status CheckFilesAreKept(const formats::FilesRead& read, const fs::path& folder) {
  RETURN_IF_ERROR(read.CheckNotReplacedBy(folder / kSurfaceJson));
  for (const quality::SurfaceFormat format : quality::kSurfaceFormats)
    RETURN_IF_ERROR(read.CheckNotReplacedBy(folder / quality::FileOf(format)));
  return absl::OkStatus();
}

absl::Status RunSurface(const SurfaceCommandOptions& options) {
  RETURN_IF_ERROR(CheckUsage(options));
  config::SurveySettings settings;
  if (!options.merges()) {
    ASSIGN_OR_RETURN(settings, SettingsOf(options.flags));
  }
  ASSIGN_OR_RETURN(const formats::FilesRead read, FilesReadBy(options, settings));
  if (!options.partial.empty()) {
    RETURN_IF_ERROR(read.CheckNotReplacedBy(options.partial));
    return RunPartial(options, settings);
  }
  RETURN_IF_ERROR(CheckFilesAreKept(read, options.output));
  const std::vector<quality::SurfaceFormat> formats = FormatsOf(options);
  std::vector<quality::AnnotatedLasFile> files;
  std::vector<quality::SurfacePart> parts;
  if (options.merges()) {
    ASSIGN_OR_RETURN(parts, PartsOf(options, formats));
  } else {
    ASSIGN_OR_RETURN(files, quality::OpenAnnotated(PathsOf(options)));
    RETURN_IF_ERROR(quality::CheckFormats(formats, quality::MapOf(files.front())));
  }
  const quality::NewFolder folder(options.output);
  RETURN_IF_ERROR(PrepareFolder(options.output, options.existing));
  const HiddenFolder hidden(options.output);
  if (hidden.path().empty()) return NotWritable(options.output);
  const fs::path points = hidden.path() / ".points";
  if (!options.merges()) {
    ASSIGN_OR_RETURN(quality::SurfacePart part, Gather(options, settings, files, points));
    parts.push_back(std::move(part));
  }
  ASSIGN_OR_RETURN(const quality::MadeSurface surface, quality::MakeSurface(std::move(parts), hidden.path()));
  std::error_code not_there;
  fs::remove(points, not_there);
  RETURN_IF_ERROR(quality::WriteRasters(surface, formats, options.organisation));
  const std::string text = surface.json->dump(2) + "\n";
  std::ofstream json(hidden.path() / kSurfaceJson);
  json << text;
  json.close();
  if (!json) return NotWritable(options.output);
  std::vector<std::string> names = {kSurfaceJson};
  for (const quality::SurfaceFormat format : formats) names.push_back(quality::FileOf(format));
  for (const quality::SurfaceFormat other : quality::kSurfaceFormats)  // Of an earlier surface.
    if (std::ranges::count(formats, other) == 0)
      fs::remove(fs::path(options.output) / quality::FileOf(other), not_there);
  RETURN_IF_ERROR(hidden.Publish(names));
  std::cout << (options.json ? text : options.output + "\n" + PrintableLines(quality::SurfaceText(*surface.json)));
  return FlushStandardOutput();
}

}  // namespace

void AddSurfaceCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<SurfaceCommandOptions>();
  CLI::App* command = program.add_subcommand(
      "surface", "The surface of a survey from its annotated files: nodes of a grid, and the uncertainty of each");
  command
      ->add_option("OUT_DIR", options->inputs,
                   "Folder that albtpu-query las --details wrote, or files in it; or the word merge and parts")
      ->required();
  command->add_option("--output", options->output, "Folder for the files of the formats and surface.json")
      ->check(NotEmpty("folder"));
  AddList(*command, "--format", options->formats,
          "Of surface.nc, surface.tif (Cloud Optimized) and surface.bag: one, or several with commas (default: netcdf)",
          OneOf({quality::kSurfaceFormatNames.begin(), quality::kSurfaceFormatNames.end()}))
      ->type_name("netcdf|geotiff|bag");
  command->add_option("--organisation", options->organisation, "Who answers for the surface, for the metadata of BAG");
  command
      ->add_option("--partial", options->partial,
                   "In place of --output: a file with all that merge needs of these input files")
      ->check(NotEmpty("file"));
  command->add_option("--cell", options->cell, "Side of the cells, each of which has a node [m] (default: 1)")
      ->check(NumberIn(0.1, 20, "m"));
  command->add_flag("--land", options->land,
                    "Also nodes of land: of the points of the ground (class 2; 8 in formats 0 to 5), and of the bottom "
                    "where it lay dry, by their own totals");
  command->add_flag_callback(
      "--overwrite", [options] { options->existing = Existing::kReplace; }, "Replace an earlier surface or part");
  command->add_flag("--json", options->json, "Print what surface.json has");
  Group(*command, "How points are gathered", {"--cell", "--land"});
  Group(*command, "Output", {"--output", "--format", "--organisation", "--partial", "--json", "--overwrite"});
  AddSeaFlags(*command, options->flags, kOfWindsAlone);
  EndHelp(*command,
          "Neighbouring pulses share waves; how much follows from the sea. Where the files were annotated with waves,\n"
          "not with a wind, give these again.\n"
          "Several processes make parts of some files each; albtpu-query surface merge PART... --output DIR makes the\n"
          "surface of them that one process would make of all files. GeoTIFF and BAG need GDAL.",
          "annotated --output surface --cell 2 --survey survey.toml",
          "merge a.part b.part --output surface --format netcdf,geotiff,bag");
  command->callback([options, &run] { run = [options] { return RunSurface(*options); }; });
}

}  // namespace albtpu::programs
