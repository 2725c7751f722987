#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "annotate/las/las_annotation.h"
#include "annotate/run/annotation_run.h"
#include "annotate/run/file_progress.h"
#include "annotate/totals/plan_total.h"
#include "programs/command_line/command_line.h"
#include "programs/query/commands.h"
#include "programs/query/first_contact.h"
#include "programs/query/las_folder.h"
#include "programs/query/las_options.h"
#include "status/status_macros.h"

namespace albtpu::programs {
namespace {

// The message for a file that has no point of the given classes, or only withheld ones.
std::string ClassHint(const annotate::Job& job, const annotate::AnnotatedLas& annotated) {
  const std::string classes = absl::StrJoin(annotated.chosen_classes, " or ");
  if (annotated.withheld > 0)
    return absl::StrCat(job.input.string(), ": all points of class ", classes, " are withheld (", annotated.withheld,
                        "; the file has ", annotated.classes.Text(),
                        "); give them numbers by --use-withheld, or name other bathymetric classes with --classes");
  const int min_class = *annotated.chosen_classes.begin();
  const bool never = annotated.point_format < formats::kFirstModernFormat && formats::kLegacyClassMask < min_class;
  return absl::StrCat(job.input.string(), ": no point of class ", classes, " (",
                      never ? absl::StrCat("classes of point format ", annotated.point_format, " end at ",
                                           formats::kLegacyClassMask, "; ")
                            : "",
                      "the file has ", annotated.classes.Text(), "); name its bathymetric classes with --classes");
}

// What the surveyor calls it, for reports. It decides no number, so that it is none of the parameters of a run.
void AddNames(const config::SurveySettings& settings, nlohmann::ordered_json& input) {
  if (settings.datum.name.has_value()) input["vertical_datum"] = *settings.datum.name;
  if (nlohmann::ordered_json project = ProjectJson(settings.project); !project.empty())
    input["project"] = std::move(project);
}

nlohmann::ordered_json InputJson(const annotate::AnnotatedLas& annotated) {
  nlohmann::ordered_json json = {{"format", std::string(Name(annotated.input_kind))},
                                 {"point_format", annotated.point_format},
                                 {"points", annotated.classes.points()},
                                 {"points_by_class", annotated.classes.Json()},
                                 {"geometry", *annotated.geometry}};
  if (!annotated.sea->is_null()) json["sea"] = *annotated.sea;
  if (annotated.withheld > 0) json["withheld"] = annotated.withheld;
  if (annotated.synthetic > 0) json["synthetic"] = annotated.synthetic;
  if (!annotated.notes.empty()) json["notes"] = annotated.notes;
  if (annotated.copc_index_left_out) json["left_out"] = {"index of COPC"};
  return json;
}

// What was assumed: of several scanners once where it is the same, otherwise with the channel.
std::vector<std::string> AssumedOf(const annotate::LasAnnotation& annotation) {
  if (annotation.channels.empty()) return annotate::Assumptions(*annotation.total);
  std::map<std::string, std::vector<std::string>> channels;
  std::vector<std::string> lines, assumed;
  for (const annotate::LasChannel& channel : annotation.channels) {
    for (const std::string& line : annotate::Assumptions(channel.total)) {
      if (!channels.contains(line)) lines.push_back(line);
      channels[line].push_back(channel.label);
    }
  }
  for (const std::string& line : lines) {
    const bool of_all = channels[line].size() == annotation.channels.size();
    assumed.push_back(of_all ? line : absl::StrCat(absl::StrJoin(channels[line], " and "), ": ", line));
  }
  return assumed;
}

// Of the water, what was entered and what it became; and what was assumed.
std::vector<std::string> StatementsOf(const annotate::LasAnnotation& annotation) {
  std::vector<std::string> lines = AssumedOf(annotation);
  // All scanners see one water.
  const annotate::TotalPlan& plan = annotation.channels.empty() ? *annotation.total : annotation.channels.front().total;
  const std::string water = annotate::WaterText(annotate::Parameters(plan));
  if (!water.empty()) lines.insert(lines.begin(), water);
  return lines;
}

// The contribution of the sea, and the total beside it.
nlohmann::ordered_json AnswersJson(const annotate::LasAnnotation& annotation, const annotate::AnnotatedLas& annotated) {
  nlohmann::ordered_json json = annotated.summary.Json();
  if (!annotation.total.has_value()) return json;
  json = annotate::WithTotal(std::move(json), *annotation.total, annotated.totals, annotated.totals_by_line);
  for (std::size_t i = 0; i < annotation.channels.size(); ++i) {
    const annotate::LasChannel& channel = annotation.channels[i];
    nlohmann::ordered_json of_channel = {{"name", channel.label}, {"points", annotated.points_by_channel[i]}};
    of_channel["total"] = annotated.totals_by_channel[i].Json();
    of_channel["total"]["assumed"] = annotate::Assumptions(channel.total);
    json["channels"].push_back(std::move(of_channel));
  }
  if (!annotation.channels.empty()) json["total"]["assumed"] = AssumedOf(annotation);
  if (annotation.plan.dry_points) {
    json["dry"] = annotated.dry.Json();
    json["dry"]["submerged"] = annotated.submerged;
    if (!annotation.channels.empty()) json["dry"]["no_channel"] = annotated.dry_without_channel;
  }
  return json;
}

std::string AnswersText(const annotate::LasAnnotation& annotation, const annotate::AnnotatedLas& annotated,
                        const client::TableSummary& table) {
  if (!annotation.total.has_value()) return annotated.summary.Text(annotate::WithoutAzimuth(table));
  const S44Order order = annotation.style.s44_order.value_or(S44Order::k1b);
  std::string text = absl::StrCat(annotated.summary.outcomes().Text(annotate::WithoutAzimuth(table)),
                                  annotated.totals.Text(annotation.style.coverage, order));
  if (annotated.dry.count() > 0) absl::StrAppend(&text, "\n  ", annotated.dry.Text(annotation.style.coverage));
  for (std::size_t i = 0; i < annotation.channels.size(); ++i)
    absl::StrAppend(&text, "\n  ", annotation.channels[i].label, ": ", annotated.points_by_channel[i], " points, ",
                    annotated.totals_by_channel[i].count(), " bathymetric with a total");
  for (const std::string& line : StatementsOf(annotation)) absl::StrAppend(&text, "\n  ", line);
  return text;
}

class LasFiles {
 public:
  // `settings` must outlive it.
  LasFiles(const LasOptions& options, const config::SurveySettings& settings, const annotate::LasAnnotation& annotation,
           std::optional<formats::LasKind> kind, const annotate::AnswerSource& source, std::size_t files)
      : options_(options),
        settings_(settings),
        annotation_(annotation),
        kind_(kind),
        source_(source),
        many_(!options.files.output_folder.empty() || files > 1),
        together_(files > 1 && annotation.total.has_value() && annotation.channels.empty()) {}

  absl::StatusOr<annotate::AnnotatedFile> Annotate(const annotate::Job& job, annotate::FileProgress& progress) {
    const bool alone = IsCsvAlone(options_);
    const annotate::LasOutputs outputs = {.las = alone ? std::filesystem::path() : job.output,
                                          .csv = alone ? job.output : job.csv};
    ASSIGN_OR_RETURN(annotate::AnnotatedLas annotated, annotate::AnnotateLas(job.input, outputs, options_.existing,
                                                                             annotation_, source_, progress, kind_));
    const std::string format = alone ? "CSV" : std::string(Name(annotated.output_kind));
    const std::uint64_t csv_bytes = annotated.csv.has_value() ? annotated.csv->size() : 0;
    const std::uint64_t points = annotated.classes.points();
    const std::uint64_t bathymetric = annotated.summary.outcomes().total();
    const bool none = points > 0 && bathymetric == 0 && annotated.dry.count() == 0;
    // A single file without the class points to a wrong --classes; among many files it may be dry land.
    if (none && !many_) return absl::FailedPreconditionError(ClassHint(job, annotated) + "; nothing was written");
    if (none) annotate::Note(ClassHint(job, annotated) + "; all its points get no-data");
    if (!none && points > 0 && bathymetric == 0)
      annotate::Note(ClassHint(job, annotated) + "; all others are taken as dry");
    if (std::holds_alternative<annotate::AcrossTrackScan>(annotation_.plan.source))
      NoteResolution(annotated.point_format);
    points_ += points;
    numbered_ += bathymetric + annotated.dry.count();
    nlohmann::ordered_json input = InputJson(annotated);
    AddNames(settings_, input);
    if (together_) folder_.Add(job.output.filename().string(), annotated);
    const std::string text =
        together_ ? LasFolder::LineOf(annotated, annotation_.style.s44_order.value_or(S44Order::k1b))
                  : absl::StrCat("\n  ", points,
                                 " points; bathymetric: ", AnswersText(annotation_, annotated, source_.table()),
                                 NotesText(annotated));
    return annotate::AnnotatedFile{
        std::move(annotated.file),
        annotate::Findings{.input_bytes = annotated.input_bytes,
                           .csv_bytes = csv_bytes,
                           .input = annotate::JsonBox(std::move(input)),
                           .output = annotate::JsonBox(nlohmann::ordered_json{{"format", format}}),
                           .answers = annotate::JsonBox(AnswersJson(annotation_, annotated)),
                           .tally = annotated.summary.Tally()},
        text, std::move(annotated.csv)};
  }

  bool found_none() const { return points_ > 0 && numbered_ == 0; }

  // What several files have together, once.
  void NoteTogether() const {
    if (folder_.files() == 0) return;
    const S44Order order = annotation_.style.s44_order.value_or(S44Order::k1b);
    annotate::Note("all files:", folder_.Text(annotation_.style.coverage, order, StatementsOf(annotation_)));
  }

 private:
  static std::string NotesText(const annotate::AnnotatedLas& annotated) {
    std::string text;
    for (const std::string& note : annotated.notes) absl::StrAppend(&text, "\n  ", note);
    return text;
  }

  // Once for all files, which mostly have the same point format.
  void NoteResolution(int point_format) {
    if (point_format >= formats::kFirstModernFormat || resolution_noted_) return;
    annotate::Note(absl::StrCat("point format ", point_format,
                                ": scan angles are whole degrees, so incidence is known to 0.5 degrees"));
    resolution_noted_ = true;
  }

  const LasOptions& options_;
  const config::SurveySettings& settings_;
  const annotate::LasAnnotation& annotation_;
  std::optional<formats::LasKind> kind_;  // Of the outputs.
  annotate::AnswerSource source_;
  bool many_;      // Files of a folder, of which some may be dry land.
  bool together_;  // One table for all of them.
  LasFolder folder_;
  bool resolution_noted_ = false;
  std::uint64_t points_ = 0, numbered_ = 0;
};

// Opens the trajectories of the plan and reads its water levels, once for all files.
absl::Status OpenFilesOf(annotate::BeamPlan& plan) {
  if (const auto* files = std::get_if<annotate::TrajectoryFromFiles>(&plan.source)) {
    ASSIGN_OR_RETURN(formats::TrajectoryFiles trajectories,
                     formats::LoadTrajectories(files->paths, files->velocity_axes));
    for (const std::string& line : trajectories.skipped()) annotate::Note(line);
    plan.trajectories = std::make_shared<const formats::TrajectoryFiles>(std::move(trajectories));
    ASSIGN_OR_RETURN(plan.trajectory_errors, formats::LoadTrajectoryErrors(files->errors));
    for (const std::string& line : plan.trajectory_errors.skipped()) annotate::Note(line);
  }
  if (!plan.water_level_file.has_value()) return absl::OkStatus();
  ASSIGN_OR_RETURN(formats::WaterLevelSeries levels,
                   formats::ReadWaterLevels(*plan.water_level_file, plan.level_reference));
  plan.water_levels = std::make_shared<const formats::WaterLevelSeries>(std::move(levels));
  return absl::OkStatus();
}

// What trajectories without error files state of their own errors, as those in ASCII may.
std::vector<std::string_view> StatedErrorsOf(const annotate::BeamPlan& plan) {
  std::vector<std::string_view> stated;
  if (plan.trajectories == nullptr || !plan.trajectory_errors.empty()) return stated;
  const auto any_states = [&](double formats::TrajectorySigma::*sigma) {
    return std::ranges::any_of(*plan.trajectories, [&](const auto& each) {
      const std::optional<formats::TrajectorySigma> of_first = each->SigmaAt(0);
      return of_first.has_value() && std::isfinite((*of_first).*sigma);
    });
  };
  if (any_states(&formats::TrajectorySigma::north)) stated.emplace_back("position");
  if (any_states(&formats::TrajectorySigma::roll)) stated.emplace_back("attitude");
  return stated;
}

// The inputs in which a mistake in the coordinates is sought.
annotate::CauseContext ContextOf(const annotate::BeamPlan& plan, const client::TableSummary& table) {
  annotate::CauseContext context{
      .axes = table.axes,
      .water_level = {},
      .water_level_by_time = plan.water_level_file.has_value(),
      .footprint_from_beam = std::holds_alternative<annotate::DivergingBeam>(plan.footprint)};
  if (plan.water_level.has_value() && plan.water_classes.empty())
    context.water_level = *plan.water_level * plan.metres_per_unit.value_or(1);
  return context;
}

absl::Status RunLas(const LasOptions& options, const CLI::App& command) {
  ASSIGN_OR_RETURN(const config::SurveySettings settings, SettingsOf(options));
  const config::SeaSettings& sea = settings.sea;
  ASSIGN_OR_RETURN(const std::vector<config::OpenDecision> open, OpenDecisionsOf(options, settings));
  if (!open.empty() && open.size() + (annotate::IsOutputMissing(options.files) && options.csv.empty() ? 1 : 0) > 1) {
    ASSIGN_OR_RETURN(const FirstContact contact, ContactOf(options, settings, open, GivenArguments(command)));
    return Refuse(contact);
  }
  ASSIGN_OR_RETURN(annotate::LasAnnotation annotation, Annotation(options, settings));
  ASSIGN_OR_RETURN(const std::optional<formats::LasKind> kind, OutputKind(options));
  ASSIGN_OR_RETURN(const std::vector<annotate::Job> jobs, JobsOf(options));
  RETURN_IF_ERROR(OpenFilesOf(annotation.plan));
  for (const std::string_view source : StatedErrorsOf(annotation.plan)) {
    if (annotation.total.has_value()) annotate::TakeErrorsOfTrajectory(source, *annotation.total);
    for (annotate::LasChannel& channel : annotation.channels) annotate::TakeErrorsOfTrajectory(source, channel.total);
  }
  for (annotate::LasChannel& channel : annotation.channels) {
    channel.plan.trajectories = annotation.plan.trajectories;
    channel.plan.trajectory_errors = annotation.plan.trajectory_errors;
    channel.plan.water_levels = annotation.plan.water_levels;
  }
  ASSIGN_OR_RETURN(Answerer answerer, Answerer::Open(sea, options.source, annotate::IndexOrUsual(settings.water)));
  annotation.seas = answerer.timeline();
  const annotate::AnswerSource source = answerer.source();
  if (annotation.total.has_value() && !sea.has_waves()) {
    annotation.total->wave_height = annotate::WaveHeightOfWind(annotation.plan.wind_speed, annotation.plan.fetch,
                                                               annotate::SpectrumOf(source.table()));
    for (annotate::LasChannel& channel : annotation.channels) channel.total.wave_height = annotation.total->wave_height;
  }
  if (options.style.standard_errors) annotate::Note(answerer.ErrorNote());
  LasFiles files(options, settings, annotation, kind, source, jobs.size());
  std::vector<std::filesystem::path> read = FilesOf(options.flags, settings);
  for (const std::string& file : annotate::FilesOf(annotation.plan)) read.emplace_back(file);
  if (!options.source.file.empty()) read.push_back(options.source.file);
  nlohmann::ordered_json parameters = Parameters(annotation, sea, options.format);
  parameters["sea_index"] = annotate::IndexOrUsual(settings.water);
  const absl::Status status = annotate::AnnotateFiles(
      jobs,
      {.command = "las",
       .records = "points",
       .record = "chosen point",
       .parameters = annotate::JsonBox(std::move(parameters)),
       .files = std::move(read),
       .resume = options.files.resume,
       .existing = options.existing,
       .json = options.files.json,
       .annotate = [&](const annotate::Job& job,
                       annotate::FileProgress& progress) { return files.Annotate(job, progress); },
       .cause = ContextOf(annotation.plan, source.table())},
      source.table());
  files.NoteTogether();
  // With --resume, the files that were skipped may have such points.
  if (status.ok() && !options.files.resume && files.found_none())
    return absl::FailedPreconditionError("no file has a point of the bathymetric classes; name them with --classes");
  return status.ok() ? FlushStandardOutput() : status;
}

}  // namespace

void AddLasCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<LasOptions>();
  CLI::App* command = program.add_subcommand("las",
                                             "Copy LAS and LAZ files (1.0 to 1.5) and append to each point "
                                             "total_thu and total_tvu, or without a sensor "
                                             "sea_thu and sea_tvu");
  AddLasOptions(*command, *options);
  command->callback([options, command, &run] { run = [options, command] { return RunLas(*options, *command); }; });
}

}  // namespace albtpu::programs
