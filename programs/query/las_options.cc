#include "programs/query/las_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "annotate/run/file_progress.h"
#include "annotate/totals/plan_total.h"
#include "config/sensors/sensor.h"
#include "formats/las/las_points.h"
#include "programs/command_line/command_line.h"
#include "programs/query/commands.h"
#include "programs/query/options.h"
#include "status/status_macros.h"

namespace albtpu::programs {
namespace {

constexpr char kCsv[] = ".csv";

absl::StatusOr<annotate::TotalPlan> TotalOf(const config::SurveySettings& settings, const annotate::BeamPlan& plan,
                                            bool is_divergence_given, Coverage coverage) {
  annotate::TotalContext context{.coverage = coverage,
                                 .has_surface_returns = !plan.water_classes.empty(),
                                 .has_level = plan.water_level.has_value() || plan.water_level_file.has_value(),
                                 .trajectory_errors = settings.trajectory.errors.empty() ? "" : "--trajectory-errors"};
  ASSIGN_OR_RETURN(annotate::TotalPlan total, annotate::PlanTotal(settings, context));
  if (const auto* beam = std::get_if<annotate::DivergingBeam>(&plan.footprint); beam != nullptr && !is_divergence_given)
    total.numbers.push_back(annotate::AssumedDivergence(beam->divergence));
  if (plan.wind_from.has_value()) total.sea_axis = static_cast<float>(std::fmod(*plan.wind_from + 540, 360));
  return total;
}

// The divergence is that of the sensor where nothing else gives the size of the beam of a total.
absl::StatusOr<BeamOptions> WithSensor(BeamOptions beams, const config::SurveySettings& settings) {
  if (!settings.sensor.name.has_value() || beams.divergence.has_value() ||
      beams.fixed[annotate::PulseInput::kFootprint].has_value())
    return beams;
  ASSIGN_OR_RETURN(const config::Sensor sensor, config::FindSensor(*settings.sensor.name));
  if (sensor.divergence.has_value()) beams.divergence = sensor.divergence->value;
  return beams;
}

// The flags of the beams of one channel, which states what belongs to its scanner.
BeamOptions OfChannel(BeamOptions beams, const config::ChannelSettings& channel) {
  if (channel.footprint.has_value() || channel.divergence.has_value()) {
    beams.fixed[annotate::PulseInput::kFootprint].reset();
    beams.divergence = beams.aperture = std::nullopt;
  }
  if (channel.footprint.has_value())
    beams.fixed[annotate::PulseInput::kFootprint] = static_cast<float>(*channel.footprint);
  if (channel.divergence.has_value()) beams.divergence = channel.divergence;
  if (channel.aperture.has_value()) beams.aperture = channel.aperture;
  if (channel.incidence.has_value()) beams.incidence = channel.incidence;
  return beams;
}

// What is open of the beams, with the height that those of a total need.
std::vector<config::OpenDecision> OpenOfBeams(const BeamOptions& beams, const config::SurveySettings& settings) {
  std::vector<config::OpenDecision> open = OpenDecisionsOf(beams, settings);
  const bool by_angle = beams.scanner.has_value() || beams.incidence.has_value();
  if (settings.wants_total() && by_angle && !beams.altitude.has_value())
    open.push_back({"--altitude", "--altitude is missing; a total needs the height of the sensor above the water"});
  return open;
}

// The survey and the flags of each scanner.
std::vector<std::pair<config::SurveySettings, BeamOptions>> ScannersOf(const LasOptions& options,
                                                                       const config::SurveySettings& settings) {
  if (settings.sensor.channels.empty()) return {{settings, options.beams}};
  std::vector<std::pair<config::SurveySettings, BeamOptions>> scanners;
  for (const config::ChannelSettings& channel : settings.sensor.channels)
    scanners.emplace_back(settings.OfChannel(channel), OfChannel(options.beams, channel));
  return scanners;
}

struct ScannerPlan {
  annotate::BeamPlan beams;
  std::optional<annotate::TotalPlan> total;
};

absl::StatusOr<ScannerPlan> PlanOf(const LasOptions& options, const BeamOptions& flags,
                                   const config::SurveySettings& settings, const annotate::LasAnnotation& annotation) {
  ASSIGN_OR_RETURN(const BeamOptions beams, WithSensor(flags, settings));
  const std::vector<config::OpenDecision> open = OpenOfBeams(beams, settings);
  if (!open.empty()) return formats::UsageError(absl::StrCat("las: ", open.front().message));
  const bool total = settings.wants_total();
  ScannerPlan plan;
  ASSIGN_OR_RETURN(plan.beams, MakePlan(beams, options.flags.settings, settings, annotation.details || total));
  plan.beams.any_aircraft = total;
  plan.beams.dry_points = settings.output.points.value_or(total ? "all" : "bathymetric") == "all";
  if (!total) return plan;
  ASSIGN_OR_RETURN(plan.total, TotalOf(settings, plan.beams, flags.divergence.has_value(), annotation.style.coverage));
  return plan;
}

absl::Status CheckTerrain(const annotate::LasAnnotation& annotation, const annotate::BeamPlan& plan) {
  if (!annotation.terrain_slope) return absl::OkStatus();
  if (!plan.dry_points)
    return formats::UsageError("las: --terrain-slope is of dry points; it needs a sensor, and no --points bathymetric");
  if (plan.has_track()) return absl::OkStatus();
  return formats::UsageError(
      "las: --terrain-slope needs the direction and the footprint of each beam; give --trajectory or "
      "--trajectory-from-returns");
}

// The canonical path, of a file that need not exist.
std::filesystem::path Placed(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::path placed = std::filesystem::weakly_canonical(path, error);
  return error ? path.lexically_normal() : placed;
}

}  // namespace

void AddLasOptions(CLI::App& command, LasOptions& options) {
  AddFileOptions(command, ".las", options.files, options.existing);
  command
      .add_option(
          "--csv", options.csv,
          "Write GPS time, x, y, z, THU, TVU and class of each point as CSV: a file, or an existing folder for a "
          "file of each input. With OUT or --output-dir beside LAS or LAZ, otherwise alone")
      ->type_name("OUT.csv|DIR")
      ->check(NotEmpty("file or folder"))
      ->group(group::kFiles);
  AddBeamOptions(command, options.beams, options.flags);
  AddSeaFlags(command, options.flags, kRareSeaFlags);
  AddTotalFlags(command, options.flags);
  AddFlags(command, {"--classes", "--points", "--use-withheld", "--terrain-slope"}, group::kPoints, options.flags);
  AddFlags(command, {"--details"}, group::kOutput, options.flags);
  command
      .add_flag("--replace", options.replace,
                "Where the points have dimensions of these names already, as floats or doubles, replace their "
                "values")
      ->group(group::kOutput);
  command
      .add_option_function<std::string>(
          "--format",
          [&options](const std::string& text) {
            options.format = text == "laz" ? formats::LasKind::kLaz : formats::LasKind::kLas;
          },
          "Write all outputs as las or laz (default: by the name of OUT; otherwise each as its input). With "
          "--output-dir it also changes their extension")
      ->check(CLI::IsMember({"las", "laz"}))
      ->type_name("las|laz")
      ->group(group::kOutput);
  AddSourceOptions(command, options.source);
  AddStyleFlags(command, options.flags, options.style);
  EndHelp(command,
          absl::StrCat("OUT.laz is compressed, as by LASzip, OUT.las is not.\n"
                       "Where each beam went is given in one of four ways: --trajectory, --trajectory-from-returns,\n"
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

std::vector<std::string> LasExtensions() {
  return {formats::Extension(formats::LasKind::kLas), formats::Extension(formats::LasKind::kLaz)};
}

absl::StatusOr<config::SurveySettings> SettingsOf(const LasOptions& options) {
  absl::StatusOr<config::SurveySettings> settings = SettingsOf(options.flags);
  if (settings.ok() && (options.beams.scanner.has_value() || options.beams.incidence.has_value()))
    settings->trajectory = options.flags.settings.trajectory;
  return settings;
}

absl::StatusOr<std::vector<config::OpenDecision>> OpenDecisionsOf(const LasOptions& options,
                                                                  const config::SurveySettings& settings) {
  std::vector<config::OpenDecision> open;
  const auto add = [&](const config::OpenDecision& decision) {  // Once, where several channels leave it open.
    if (std::ranges::find(open, decision.message, &config::OpenDecision::message) == open.end())
      open.push_back(decision);
  };
  for (const auto& [of_scanner, flags] : ScannersOf(options, settings)) {
    ASSIGN_OR_RETURN(const BeamOptions beams, WithSensor(flags, of_scanner));
    std::ranges::for_each(OpenOfBeams(beams, of_scanner), add);
    // The surface is among those of the beams.
    if (of_scanner.wants_total()) std::ranges::for_each(annotate::UndecidedOf(of_scanner, {.has_level = true}), add);
  }
  return open;
}

absl::StatusOr<annotate::LasAnnotation> Annotation(const LasOptions& options, const config::SurveySettings& settings) {
  RETURN_IF_ERROR(CheckTotalFlags(options.flags, settings));
  annotate::LasAnnotation annotation;
  annotation.replace = options.replace;
  annotation.style = options.style;
  TakeStyle(settings.output, annotation.style);
  annotation.details = settings.output.details.value_or(false);
  annotation.use_withheld = settings.output.use_withheld.value_or(false);
  if (!settings.output.classes.empty())
    annotation.classes.emplace(settings.output.classes.begin(), settings.output.classes.end());
  const bool total = settings.wants_total();
  annotation.terrain_slope = settings.output.terrain_slope.value_or(false);
  std::vector<ScannerPlan> plans;
  for (const auto& [of_scanner, flags] : ScannersOf(options, settings)) {
    ASSIGN_OR_RETURN(ScannerPlan plan, PlanOf(options, flags, of_scanner, annotation));
    RETURN_IF_ERROR(CheckTerrain(annotation, plan.beams));
    plans.push_back(std::move(plan));
  }
  if (plans.front().beams.dry_points && !total)
    return formats::UsageError("las: --points all needs a sensor: without one, only the sea adds to the uncertainty");
  // A return is either from the water surface or from the bottom: in both, every depth would be 0.
  for (const int point_class : annotation.ClassesOf(formats::kFirstModernFormat)) {
    if (!plans.front().beams.water_classes.contains(point_class)) continue;
    return formats::UsageError(absl::StrCat("las: class ", point_class,
                                            " is both a class of the water surface and of the bottom; name different "
                                            "classes by --water-classes and --classes"));
  }
  for (std::size_t i = 0; i < settings.sensor.channels.size(); ++i) {
    const config::ChannelSettings& channel = settings.sensor.channels[i];
    annotation.channels.push_back({.label = channel.label(),
                                   .points = {{channel.scanner_channels.begin(), channel.scanner_channels.end()},
                                              {channel.user_data.begin(), channel.user_data.end()}},
                                   .plan = plans[i].beams,
                                   .total = *plans[i].total});
  }
  annotation.plan = std::move(plans.front().beams);
  annotation.total = std::move(plans.front().total);
  return annotation;
}

bool IsCsvAlone(const LasOptions& options) { return !options.csv.empty() && annotate::IsOutputMissing(options.files); }

absl::StatusOr<std::vector<annotate::Job>> JobsOf(const LasOptions& options) {
  annotate::FileOptions files = options.files;
  if (options.format.has_value()) files.output_extension = formats::Extension(*options.format);
  std::error_code ignored;
  const bool folder = std::filesystem::is_directory(options.csv, ignored);
  if (IsCsvAlone(options)) {
    if (options.format.has_value())
      return formats::UsageError("las: --format has no effect with --csv alone; leave it out");
    files.output_extension = kCsv;
    if (folder)
      files.output_folder = options.csv;
    else if (files.files.size() == 1)
      files.files.push_back(options.csv);
    else
      return formats::UsageError(absl::StrCat("las: --csv ", options.csv, " is no folder, in which each of ",
                                              files.files.size(), " inputs has a file; give one that exists"));
  }
  ASSIGN_OR_RETURN(std::vector<annotate::Job> jobs, annotate::FindJobs("las", LasExtensions(), files));
  if (options.csv.empty() || IsCsvAlone(options)) return jobs;
  if (folder && files.output_folder.empty() && std::filesystem::exists(jobs.front().output, ignored) &&
      !std::filesystem::exists(annotate::SummaryPath(jobs.front().output), ignored)) {
    return formats::UsageError(
        absl::StrCat("las: ", jobs.front().output.string(), " would be the output of ", jobs.front().input.string(),
                     ", but is another file; if both are inputs, add --output-dir DIR or annotate one at a time"));
  }
  if (!folder && jobs.size() > 1) {
    return formats::UsageError(absl::StrCat("las: --csv ", options.csv, " is no folder, in which each of ", jobs.size(),
                                            " inputs has a file; give one that exists"));
  }
  std::set<std::filesystem::path> names;
  for (annotate::Job& job : jobs) {
    const std::filesystem::path name =
        files.output_folder.empty() ? job.output.filename() : job.output.lexically_relative(files.output_folder);
    job.csv = folder ? (std::filesystem::path(options.csv) / name).replace_extension(kCsv)
                     : std::filesystem::path(options.csv);
    if (const std::filesystem::path csv = Placed(job.csv);
        csv == Placed(job.output) || csv == Placed(annotate::SummaryPath(job.output)) || !names.insert(csv).second) {
      return formats::UsageError(absl::StrCat("las: two outputs would be called ", job.csv.string(),
                                              "; give --csv another name, or annotate the inputs one at a time"));
    }
  }
  return jobs;
}

absl::StatusOr<std::optional<formats::LasKind>> OutputKind(const LasOptions& options) {
  const std::vector<std::string>& files = options.files.files;
  if (!options.files.output_folder.empty() || files.size() != 2) return options.format;
  if (annotate::HasExtension(files[1], kCsv) || annotate::HasExtension(files[1], ".txt")) {
    return formats::UsageError(absl::StrCat(
        "las: ", files[1], " would be a LAS file; name it .las or .laz, or give --csv ", files[1], " for text"));
  }
  std::optional<formats::LasKind> named;
  for (const formats::LasKind kind : {formats::LasKind::kLas, formats::LasKind::kLaz})
    if (annotate::HasExtension(files[1], formats::Extension(kind))) named = kind;
  if (options.format.has_value() && named.has_value() && *options.format != *named) {
    return formats::UsageError(absl::StrCat("las: --format ", formats::Extension(*options.format).substr(1),
                                            " and the name of the output, ", files[1],
                                            ", contradict each other; give one of them"));
  }
  return options.format.has_value() ? options.format : named;
}

nlohmann::ordered_json Parameters(const annotate::LasAnnotation& annotation, const config::SeaSettings& sea,
                                  std::optional<formats::LasKind> format) {
  nlohmann::ordered_json json = Parameters(annotation.plan);
  if (sea.has_waves()) json["sea"] = Parameters(sea);
  json["classes"] = nullptr;  // The default of the point format.
  if (annotation.classes.has_value()) json["classes"] = *annotation.classes;
  json["details"] = annotation.details;
  if (annotation.plan.dry_points) json["points"] = "all";
  if (annotation.use_withheld) json["use_withheld"] = true;
  if (annotation.terrain_slope) json["terrain_slope"] = true;
  if (annotation.replace) json["replace"] = true;
  json["format"] = nullptr;  // By the name of the output, or that of the input.
  if (format.has_value()) json["format"] = std::string(Name(*format));
  json.update(Parameters(annotation.style));
  if (annotation.channels.empty()) {
    if (annotation.total.has_value()) json["total"] = Parameters(*annotation.total);
    return json;
  }
  for (const char* const of_scanner : {"incidence", "divergence", "aperture", "footprint", "lever_arm"})
    json.erase(of_scanner);
  for (const annotate::LasChannel& channel : annotation.channels) {
    nlohmann::ordered_json of_channel = {{"scanner_channels", channel.points.channels},
                                         {"user_data", channel.points.user_data}};
    const nlohmann::ordered_json beams = Parameters(channel.plan);
    for (const char* const of_scanner : {"incidence", "divergence", "aperture", "footprint", "lever_arm"})
      if (beams.contains(of_scanner)) of_channel[of_scanner] = beams[of_scanner];
    of_channel["total"] = Parameters(channel.total);
    json["channels"].push_back(std::move(of_channel));
  }
  return json;
}

}  // namespace albtpu::programs
