#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "command_line/help.h"
#include "survey/answers/run_verdict.h"
#include "survey/commands/commands.h"
#include "survey/commands/options.h"
#include "survey/commands/sea_options.h"
#include "survey/csv/csv_annotation.h"
#include "survey/exit_status.h"
#include "survey/files/annotation_run.h"
#include "survey/files/file_jobs.h"
#include "survey/number_text.h"

namespace albtpu::client {
namespace {

struct CsvOptions {
  FileOptions files;
  Existing existing = Existing::kKeep;
  SeaOptions sea;
  SourceOptions source;
  AnswerStyle style;
  FixedInputs fixed;
};

// For a summary; null where a column of the file has it, or nothing does.
nlohmann::ordered_json Parameters(const CsvOptions& options, const ToldSea& sea) {
  nlohmann::ordered_json json;
  for (std::size_t i = 0; i < kPulseInputCount; ++i) {
    const auto input = static_cast<PulseInput>(i);
    const std::optional<float>& value = options.fixed[input];
    json[std::string(Name(input))] = value.has_value() ? JsonNumber(*value) : nlohmann::ordered_json();
  }
  if (sea.has_waves()) json["sea"] = Parameters(sea);
  json.update(Parameters(options.style));
  return json;
}

// None where only the columns of each file tell.
std::optional<bool> IsFootprintFromBeam(const FixedInputs& fixed) {
  if (fixed[PulseInput::kFootprint].has_value()) return false;
  if (fixed[PulseInput::kAltitude].has_value() || fixed[PulseInput::kDivergence].has_value()) return true;
  return std::nullopt;
}

absl::Status RunCsv(const CsvOptions& options) {
  const absl::StatusOr<SurveyDescription> survey = SurveyOf(options.sea);
  if (!survey.ok()) return survey.status();
  const absl::StatusOr<ToldSea> sea = ToldBy(options.sea, *survey);
  if (!sea.ok()) return sea.status();
  FixedInputs fixed = options.fixed;
  if (absl::Status status = TakeWind(*sea, fixed); !status.ok()) return status;
  const absl::StatusOr<std::vector<Job>> jobs = FindJobs("csv", {".csv"}, options.files);
  if (!jobs.ok()) return jobs.status();
  absl::StatusOr<Answerer> answerer = Answerer::Open(*sea, options.source);
  if (!answerer.ok()) return answerer.status();
  if (absl::Status status = answerer->CheckOneTime("csv"); !status.ok()) return status;
  const AnswerSource source = answerer->source();
  if (options.style.standard_errors) Note(answerer->ErrorNote());
  const std::string notes = answerer->SeaText();
  std::vector<std::filesystem::path> files;
  if (sea->file.has_value()) files.emplace_back(*sea->file);
  const auto annotate = [&](const Job& job, FileProgress& progress) -> absl::StatusOr<AnnotatedFile> {
    absl::StatusOr<AnnotatedCsv> csv =
        AnnotateCsv(job.input, job.output, options.existing, fixed, options.style, source, progress);
    if (!csv.ok()) return csv.status();
    return AnnotatedFile{
        std::move(csv->file),
        Findings{
            .input_bytes = csv->input_bytes, .input = answerer->SeaJson(), .answers = csv->summary.Json()},
        absl::StrCat(" ", csv->summary.outcomes().Text(WithoutAzimuth(source.table())), notes)};
  };
  RunVerdict verdict(
      {.axes = source.table().axes, .water_level = {}, .footprint_from_beam = IsFootprintFromBeam(fixed)},
      "pulse");
  const auto judge = [&](const Job& job, const nlohmann::ordered_json& answers) {
    const std::string problem = verdict.Add(job.output.string(), answers);
    if (!problem.empty() && jobs->size() > 1) Note(problem);
  };
  const absl::Status status = AnnotateFiles(*jobs,
                                            {.command = "csv",
                                             .records = "pulses",
                                             .parameters = Parameters(options, *sea),
                                             .files = files,
                                             .resume = options.files.resume,
                                             .existing = options.existing,
                                             .annotate = annotate,
                                             .finished = judge},
                                            source.table());
  if (const std::string note = verdict.DeepNote(); !note.empty()) Note(note);
  return status.ok() ? verdict.status() : status;
}

}  // namespace

void AddCsvCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<CsvOptions>();
  CLI::App* command = program.add_subcommand("csv",
                                             "Copy CSV files of pulses and append the uncertainty of each; "
                                             "columns are wind_speed, fetch, incidence, "
                                             "azimuth, footprint, depth, in any order, among others; "
                                             "beam_azimuth and wind_from may stand for azimuth, altitude "
                                             "and divergence for footprint");
  AddFileOptions(*command, ".csv", options->files, options->existing);
  for (const AxisId axis : kAxes) AddCoordinate(*command, axis, options->fixed.coordinates);
  AddBeamInputs(*command, options->fixed);
  AddSeaOptions(*command, options->sea);
  AddSourceOptions(*command, options->source);
  AddStyleOptions(*command, options->style);
  EndHelp(*command,
          absl::StrCat("A column that is missing can be given once for all pulses by its option.\n",
                       kWhereAnswersComeFrom),
          "pulses.csv with_uncertainty.csv --wind-speed 5 --footprint 0.5",
          "surveys --output-dir annotated --recursive --resume --server 127.0.0.1:50051");
  command->callback([options, &run] { run = [options] { return RunCsv(*options); }; });
}

}  // namespace albtpu::client
