#include "survey/commands/las_options.h"

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "absl/strings/str_cat.h"
#include "command_line/help.h"
#include "survey/commands/commands.h"
#include "survey/exit_status.h"
#include "survey/las/las_points.h"

namespace albtpu::client {

void AddLasOptions(CLI::App& command, LasOptions& options) {
  AddFileOptions(command, ".las", options.files, options.existing);
  AddBeamOptions(command, options.beams);
  AddSeaOptions(command, options.sea);
  command
      .add_option_function<std::string>(
          "--classes",
          [&options](const std::string& text) { options.classes = ParseClasses("--classes", text); },
          "The classes of bathymetric points (default: 40; 26 in point formats 0 to 5)")
      ->type_name("N,N")
      ->group(group::kPoints);
  command
      .add_flag("--details", options.details,
                "Also append the geometry of each beam: incidence, beam_azimuth, footprint, water_depth, "
                "slant_range")
      ->group(group::kOutput);
  command
      .add_option_function<std::string>(
          "--format",
          [&options](const std::string& text) {
            options.format = text == "laz" ? LasKind::kLaz : LasKind::kLas;
          },
          "Write all outputs as las or laz (default: by the name of OUT; otherwise each as its input). With "
          "--output-dir it also changes their extension")
      ->check(CLI::IsMember({"las", "laz"}))
      ->type_name("las|laz")
      ->group(group::kOutput);
  AddSourceOptions(command, options.source);
  AddStyleOptions(command, options.style);
  EndHelp(
      command,
      absl::StrCat(
          "OUT.laz is compressed, as by LASzip, OUT.las is not.\n"
          "Where each beam went is told in one of four ways: --trajectory, --trajectory-from-returns,\n"
          "--scanner across-track or --incidence. The water surface is --water-classes, --water-level or "
          "both.\n"
          "The beam's size is --footprint or --divergence; the latter needs --altitude where there is no\n"
          "trajectory.\n",
          kWhereAnswersComeFrom),
      "line.laz with_uncertainty.laz --trajectory-from-returns --water-level -23.09 --classes 26 "
      "--divergence 1.5 --wind-speed 5",
      "surveys --output-dir annotated --recursive --trajectory sbet --water-classes 41 --divergence 1.5 "
      "--wind-speed 5 --wind-from 250 --details");
}

absl::StatusOr<LasAnnotation> Annotation(const LasOptions& options, const ToldSea& sea) {
  BeamOptions beams = options.beams;
  if (absl::Status status = TakeWind(sea, beams.fixed); !status.ok()) return status;
  if (!beams.wind_from.has_value()) beams.wind_from = sea.wind_from;
  absl::StatusOr<BeamPlan> plan = MakePlan(beams, options.details, sea.has_waves());
  if (!plan.ok()) return plan.status();
  // A return is either from the water surface or from the bottom: in both, every depth would be 0.
  for (const int point_class : options.classes.value_or(std::set<int>{DefaultClass(kFirstModernFormat)})) {
    if (!options.beams.water_classes.contains(point_class)) continue;
    return UsageError(absl::StrCat("las: class ", point_class,
                                   " is both a class of the water surface and of the bottom; name different "
                                   "classes by --water-classes and --classes"));
  }
  return LasAnnotation{.classes = options.classes,
                       .plan = *std::move(plan),
                       .seas = nullptr,
                       .details = options.details,
                       .style = options.style};
}

absl::StatusOr<std::optional<LasKind>> OutputKind(const LasOptions& options) {
  const std::vector<std::string>& files = options.files.files;
  if (!options.files.output_folder.empty() || files.size() != 2) return options.format;
  std::optional<LasKind> named;
  for (const LasKind kind : {LasKind::kLas, LasKind::kLaz}) {
    if (HasExtension(files[1], Extension(kind))) named = kind;
  }
  if (options.format.has_value() && named.has_value() && *options.format != *named) {
    return UsageError(absl::StrCat("las: --format ", Extension(*options.format).substr(1),
                                   " and the name of the output, ", files[1],
                                   ", contradict each other; give one of them"));
  }
  return options.format.has_value() ? options.format : named;
}

nlohmann::ordered_json Parameters(const LasAnnotation& annotation, const ToldSea& sea,
                                  std::optional<LasKind> format) {
  nlohmann::ordered_json json = Parameters(annotation.plan);
  if (sea.has_waves()) json["sea"] = Parameters(sea);
  json["classes"] = nullptr;  // The default of the point format.
  if (annotation.classes.has_value()) json["classes"] = *annotation.classes;
  json["details"] = annotation.details;
  json["format"] = nullptr;  // By the name of the output, or that of the input.
  if (format.has_value()) json["format"] = std::string(Name(*format));
  json.update(Parameters(annotation.style));
  return json;
}

}  // namespace albtpu::client
