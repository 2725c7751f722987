#include "survey/commands/las_options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "absl/strings/str_cat.h"
#include "command_line/help.h"
#include "survey/commands/commands.h"
#include "survey/exit_status.h"
#include "survey/las/las_points.h"
#include "survey/sensors/installed_sensors.h"
#include "survey/totals/plan_total.h"

namespace albtpu::client {
namespace {

absl::StatusOr<TotalPlan> TotalOf(const SurveyDescription& survey, const BeamOptions& beams,
                                  const BeamPlan& plan, bool told_divergence, Coverage coverage) {
  if (!plan.has_track() && !beams.altitude.has_value())
    return UsageError("las: --altitude is missing; a total needs the height of the sensor above the water");
  TotalContext context{.coverage = coverage,
                       .index = beams.water_index,
                       .lever_arm = beams.lever_arm,
                       .has_surface_returns = !plan.water_classes.empty(),
                       .has_level = plan.water_level.has_value() || plan.water_level_file.has_value(),
                       .trajectory_errors = beams.trajectory_errors.empty() ? "" : "--trajectory-errors"};
  absl::StatusOr<TotalPlan> total = PlanTotal(survey, context);
  if (!total.ok()) return total.status();
  if (const auto* beam = std::get_if<DivergingBeam>(&plan.footprint); beam != nullptr && !told_divergence)
    total->numbers.push_back(AssumedDivergence(beam->divergence));
  if (plan.wind_from.has_value()) total->sea_axis = static_cast<float>(std::fmod(*plan.wind_from + 540, 360));
  return total;
}

}  // namespace

void AddLasOptions(CLI::App& command, LasOptions& options) {
  AddFileOptions(command, ".las", options.files, options.existing);
  AddBeamOptions(command, options.beams);
  AddSeaOptions(command, options.sea);
  AddTotalOptions(command, options.total);
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
                "slant_range; with a total also its shares, biases and covariance")
      ->group(group::kOutput);
  command
      .add_flag(
          "--replace", options.replace,
          "Where the points have dimensions of these names already, as floats or doubles, replace their "
          "values")
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

LasOptions Together(LasOptions flags, const SurveyDescription& survey) {
  BeamOptions& beams = flags.beams;
  const bool way_told = !beams.trajectory.empty() || beams.from_returns || beams.scanner.has_value() ||
                        beams.incidence.has_value();
  if (survey.trajectory.has_value() && !way_told) {
    beams.trajectory = survey.trajectory->files;
    beams.from_returns = survey.trajectory->from_returns.value_or(false);
    if (beams.trajectory_errors.empty()) beams.trajectory_errors = survey.trajectory->errors;
    if (!beams.trajectory_time.has_value()) beams.trajectory_time = survey.trajectory->time;
  }
  const bool from_files = !beams.trajectory.empty();
  if (from_files && !beams.lever_arm.has_value() && survey.sensor.has_value())
    beams.lever_arm = survey.sensor->lever_arm;
  if (from_files && !beams.geoid_separation.has_value() && survey.datum.has_value())
    beams.geoid_separation = survey.datum->geoid_separation;
  if ((from_files || beams.from_returns) && !beams.water_index.has_value() && survey.water.has_value())
    beams.water_index = IndexOf(*survey.water);
  if (const std::optional<ToldSurface>& surface = survey.surface; surface.has_value()) {
    if (beams.water_classes.empty()) beams.water_classes = {surface->classes.begin(), surface->classes.end()};
    if (!beams.water_level.has_value() && surface->level.has_value())
      beams.water_level = absl::StrCat(*surface->level);
    if (!beams.water_level.has_value()) beams.water_level = surface->level_file;
  }
  if (const std::optional<ToldOutput>& output = survey.output; output.has_value()) {
    if (!flags.classes.has_value() && !output->classes.empty())
      flags.classes = std::set<int>(output->classes.begin(), output->classes.end());
    flags.details = flags.details || output->details.value_or(false);
  }
  TakeStyle(survey, flags.style);
  return flags;
}

absl::StatusOr<LasAnnotation> Annotation(const LasOptions& options, const SurveyDescription& survey,
                                         const ToldSea& sea) {
  if (absl::Status status = CheckTotalFlags(options.total, survey); !status.ok()) return status;
  BeamOptions beams = options.beams;
  const bool total = WantsTotal(survey);
  if (total && !beams.divergence.has_value() && !beams.fixed[Index(AxisId::kFootprint)].has_value()) {
    const absl::StatusOr<Sensor> sensor = FindSensor(*survey.sensor->name);
    if (!sensor.ok()) return sensor.status();
    if (sensor->divergence.has_value()) beams.divergence = sensor->divergence->value;
  }
  if (absl::Status status = TakeWind(sea, beams.fixed); !status.ok()) return status;
  if (!beams.wind_from.has_value()) beams.wind_from = sea.wind_from;
  absl::StatusOr<BeamPlan> plan = MakePlan(beams, options.details || total, sea.has_waves());
  if (!plan.ok()) return plan.status();
  plan->any_aircraft = total;
  std::optional<TotalPlan> totals;
  if (total) {
    absl::StatusOr<TotalPlan> made =
        TotalOf(survey, beams, *plan, options.beams.divergence.has_value(), options.style.coverage);
    if (!made.ok()) return made.status();
    totals = *std::move(made);
  }
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
                       .replace = options.replace,
                       .style = options.style,
                       .total = std::move(totals)};
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
  if (annotation.replace) json["replace"] = true;
  json["format"] = nullptr;  // By the name of the output, or that of the input.
  if (format.has_value()) json["format"] = std::string(Name(*format));
  json.update(Parameters(annotation.style));
  if (annotation.total.has_value()) json["total"] = Parameters(*annotation.total);
  return json;
}

}  // namespace albtpu::client
