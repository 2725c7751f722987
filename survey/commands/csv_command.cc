#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "absl/strings/str_cat.h"
#include "survey/commands/commands.h"
#include "survey/commands/options.h"
#include "survey/csv/csv_annotation.h"
#include "survey/exit_status.h"
#include "survey/files/annotation_run.h"
#include "survey/files/file_jobs.h"
#include "survey/number_text.h"

namespace albtpu::client {
namespace {

struct CsvOptions {
  FileOptions files;
  SharedOptions shared;
  FixedCoordinates fixed;
};

// For a summary; null where a column of the file says it, or nothing does.
nlohmann::ordered_json Parameters(const CsvOptions& options) {
  nlohmann::ordered_json json;
  for (const AxisId axis : kAxes) {
    const std::optional<float>& value = options.fixed[Index(axis)];
    json[std::string(Describe(axis).name)] =
        value.has_value() ? JsonNumber(*value) : nlohmann::ordered_json();
  }
  json.update(Parameters(options.shared.style));
  return json;
}

absl::Status RunCsv(const CsvOptions& options) {
  const absl::StatusOr<std::vector<Job>> jobs = FindJobs("csv", ".csv", options.files);
  if (!jobs.ok()) return jobs.status();
  const absl::StatusOr<std::unique_ptr<UncertaintySource>> source = OpenSource(options.shared.source);
  if (!source.ok()) return source.status();
  const auto annotate = [&](const Job& job, FileProgress& progress) -> absl::StatusOr<AnnotatedFile> {
    absl::StatusOr<AnnotatedCsv> csv = AnnotateCsv(job.input, job.output, options.shared.existing,
                                                   options.fixed, options.shared.style, **source, progress);
    if (!csv.ok()) return csv.status();
    return AnnotatedFile{std::move(csv->file),
                         Findings{.input_bytes = csv->input_bytes,
                                  .input = nlohmann::ordered_json::object(),
                                  .answers = csv->summary.Json()},
                         " " + csv->summary.outcomes().Text()};
  };
  return AnnotateFiles(*jobs,
                       {.command = "csv",
                        .records = "pulses",
                        .parameters = Parameters(options),
                        .resume = options.files.resume,
                        .existing = options.shared.existing,
                        .annotate = annotate},
                       (*source)->table());
}

}  // namespace

void AddCsvCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<CsvOptions>();
  CLI::App* command = program.add_subcommand(
      "csv",
      "Repeat CSV files of pulses (columns wind_speed, fetch, incidence, azimuth, footprint, depth, in any "
      "order, among others) with the uncertainty of each");
  AddFileOptions(*command, ".csv", options->files);
  for (const AxisId axis : kAxes) AddCoordinate(*command, axis, options->fixed);
  AddSharedOptions(*command, options->shared);
  command->callback([options, &run] { run = [options] { return RunCsv(*options); }; });
}

}  // namespace albtpu::client
