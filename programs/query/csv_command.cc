#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "annotate/csv/csv_annotation.h"
#include "annotate/csv/csv_pulses.h"
#include "annotate/run/annotation_run.h"
#include "annotate/run/file_jobs.h"
#include "annotate/run/file_progress.h"
#include "annotate/totals/plan_total.h"
#include "config/sensors/sensor.h"
#include "formats/csv/csv_reader.h"
#include "formats/text/text.h"
#include "programs/command_line/command_line.h"
#include "programs/query/commands.h"
#include "programs/query/first_contact.h"
#include "programs/query/options.h"
#include "programs/query/survey_flags.h"
#include "service/printable_text.h"
#include "status/status_macros.h"

namespace albtpu::programs {
namespace {

struct CsvOptions {
  annotate::FileOptions files;
  Existing existing = Existing::kKeep;
  SurveyFlags flags;
  SourceOptions source;
  annotate::AnswerStyle style;
  annotate::FixedInputs fixed;
};

// For a summary; null where a column of the file has it, or nothing does.
nlohmann::ordered_json CsvParameters(const CsvOptions& options, const config::SeaSettings& sea) {
  nlohmann::ordered_json json;
  annotate::FixedInputs stated = options.fixed;
  StateWind(sea, stated);
  for (std::size_t i = 0; i < annotate::kPulseInputCount; ++i) {
    const auto input = static_cast<annotate::PulseInput>(i);
    const std::optional<float>& value = stated[input];
    json[std::string(Name(input))] = value.has_value() ? formats::JsonNumber(*value) : nlohmann::ordered_json();
  }
  if (sea.has_waves()) json["sea"] = Parameters(sea);
  json.update(programs::Parameters(options.style));
  return json;
}

// None where only the columns of each file give it.
std::optional<bool> IsFootprintFromBeam(const annotate::FixedInputs& fixed) {
  if (fixed[annotate::PulseInput::kFootprint].has_value()) return false;
  if (fixed[annotate::PulseInput::kAltitude].has_value() || fixed[annotate::PulseInput::kDivergence].has_value())
    return true;
  return std::nullopt;
}

// Null where no sensor is named.
absl::StatusOr<std::optional<annotate::CsvTotal>> TotalOf(const CsvOptions& options,
                                                          const config::SurveySettings& settings,
                                                          const annotate::FixedInputs& fixed) {
  RETURN_IF_ERROR(CheckTotalFlags(options.flags, settings));
  if (!settings.wants_total()) {
    if (options.flags.settings.output.details.has_value())
      return formats::UsageError("csv: --details has no effect without --sensor; leave it out");
    return std::nullopt;
  }
  ASSIGN_OR_RETURN(annotate::TotalPlan plan,
                   annotate::PlanTotal(settings, annotate::ContextOf(settings, options.style.coverage)));
  if (const std::optional<float>& wind_from = fixed[annotate::PulseInput::kWindFrom]; wind_from.has_value())
    plan.sea_axis = static_cast<float>(std::fmod(*wind_from + 540, 360));
  return annotate::CsvTotal{
      .plan = std::move(plan), .details = settings.output.details.value_or(false), .wind_spectrum = {}};
}

// One number for all pulses by which an example works.
float ExampleOf(annotate::PulseInput input) {
  switch (input) {
    case annotate::PulseInput::kIncidence:
      return 20;
    case annotate::PulseInput::kFootprint:
      return 0.5F;
    case annotate::PulseInput::kAltitude:
      return 400;
    case annotate::PulseInput::kDivergence:
      return 1;
    default:
      return 5;  // m/s of wind, m of depth
  }
}

// The flag of an example that closes what a total leaves open; empty: none does.
std::vector<std::string> ExampleFlag(const std::string& section) {
  if (section == "datum") return {"--datum-sigma", "0.1"};
  if (section == "water") return {"--water-column", "none"};
  if (section == "surface") return {"--surface-located", "pulse"};
  return {};
}

constexpr char kColumns[] = "columns";  // The section of decisions that columns of a file close.

// What the columns of a file leave open, in `contact`. Fails where no flag mends it.
absl::Status AddColumns(const std::string& input, annotate::FixedInputs fixed, const config::Sensor* sensor,
                        FirstContact& contact) {
  ASSIGN_OR_RETURN(formats::CsvReader reader, formats::CsvReader::Open(input));
  ASSIGN_OR_RETURN(const formats::CsvBlock block, reader.ReadHeader());
  formats::CsvRecord header;
  RETURN_IF_ERROR(formats::CsvRecords(input, block).Next(header).status());
  contact.found = {absl::StrCat(PrintableText(input), ": columns ", PrintableText(header.text))};
  const auto give = [&](annotate::PulseInput input_of_example) {
    fixed[input_of_example] = ExampleOf(input_of_example);
    contact.example.insert(contact.example.end(), {FlagName(input_of_example), absl::StrCat(*fixed[input_of_example])});
  };
  if (sensor != nullptr) {
    if (const absl::Status bound = annotate::CsvAircraft::Bind(input, header, fixed).status(); !bound.ok()) {
      contact.open.push_back({kColumns, std::string(bound.message())});
      give(annotate::PulseInput::kAltitude);
    }
    fixed =
        annotate::OfTotal(fixed, sensor->divergence ? std::optional(sensor->divergence->value) : std::nullopt, header);
  }
  const std::vector<AxisId> missing = annotate::MissingAxes(header, fixed);
  if (!missing.empty()) {
    contact.open.push_back(
        {kColumns, std::string(annotate::CsvPulses::Bind(input, header, fixed, {}).status().message())});
  }
  for (const AxisId axis : missing) {  // Half of another way takes the other half.
    const bool footprint = axis == AxisId::kFootprint;
    give(footprint && fixed[annotate::PulseInput::kAltitude].has_value()     ? annotate::PulseInput::kDivergence
         : footprint && fixed[annotate::PulseInput::kDivergence].has_value() ? annotate::PulseInput::kAltitude
                                                                             : annotate::InputOf(axis));
  }
  return annotate::CsvPulses::Bind(input, header, fixed, {}).status();
}

// What is open before any pulse is read; found and example by the header of the first file, if it is one on disk.
// Fails where something is wrong that no flag mends.
absl::Status LookAtPulses(const CsvOptions& options, const config::SurveySettings& settings, FirstContact& contact) {
  AddMissingOutput(options.files, ".csv", contact);
  std::optional<config::Sensor> sensor;
  bool closed = true;
  if (settings.sensor.name.has_value()) {
    ASSIGN_OR_RETURN(sensor, config::FindSensor(*settings.sensor.name));
    for (config::OpenDecision& decision :
         annotate::UndecidedOf(settings, annotate::ContextOf(settings, options.style.coverage))) {
      const std::vector<std::string> flag = ExampleFlag(decision.section);
      closed = closed && !flag.empty();
      contact.example.insert(contact.example.end(), flag.begin(), flag.end());
      contact.open.push_back(std::move(decision));
    }
  }
  ASSIGN_OR_RETURN(const std::string input, annotate::FirstInput({".csv"}, options.files));
  std::error_code unknown;
  annotate::FixedInputs fixed = options.fixed;
  TakeWind(settings.sea, fixed);
  if (std::filesystem::is_regular_file(input, unknown) || !std::filesystem::exists(input, unknown))
    RETURN_IF_ERROR(AddColumns(input, fixed, sensor.has_value() ? &*sensor : nullptr, contact));
  if (!closed) contact.example.clear();
  return absl::OkStatus();
}

absl::Status RunCsv(const CsvOptions& given, const CLI::App& command) {
  ASSIGN_OR_RETURN(const config::SurveySettings settings, SettingsOf(given.flags));
  FirstContact contact{.command = "csv", .example = GivenArguments(command)};
  const absl::Status look = LookAtPulses(given, settings, contact);
  // Of several files, others may have the columns that the first one lacks.
  const auto of_columns = std::ranges::count(contact.open, std::string_view(kColumns), &config::OpenDecision::section);
  if (contact.open.size() > 1 && std::ssize(contact.open) > of_columns) {
    RETURN_IF_ERROR(look);
    return Refuse(contact);
  }
  const config::SeaSettings& sea = settings.sea;
  CsvOptions options = given;
  TakeStyle(settings.output, options.style);
  annotate::FixedInputs fixed = options.fixed;
  TakeWind(sea, fixed);
  ASSIGN_OR_RETURN(std::optional<annotate::CsvTotal> total, TotalOf(options, settings, fixed));
  annotate::AnswerStyle style = options.style;
  if (total.has_value())
    style.coverage = Coverage::kTwoSigma;  // Of the sea's contribution, which a total takes at 2 sigma.
  ASSIGN_OR_RETURN(const std::vector<annotate::Job> jobs, annotate::FindJobs("csv", {".csv"}, options.files));
  ASSIGN_OR_RETURN(Answerer answerer, Answerer::Open(sea, options.source, annotate::IndexOrUsual(settings.water)));
  RETURN_IF_ERROR(answerer.CheckOneTime("csv"));
  const annotate::AnswerSource source = answerer.source();
  if (total.has_value() && !sea.has_waves()) {
    total->wind_spectrum = annotate::SpectrumOf(source.table());
    if (total->wind_spectrum.empty()) total->wind_spectrum = "not stated";
  }
  if (options.style.standard_errors) annotate::Note(answerer.ErrorNote());
  const std::string notes = answerer.SeaText();
  std::vector<std::filesystem::path> files = FilesOf(options.flags, settings);
  if (!options.source.file.empty()) files.push_back(options.source.file);
  const auto annotate = [&](const annotate::Job& job,
                            annotate::FileProgress& progress) -> absl::StatusOr<annotate::AnnotatedFile> {
    ASSIGN_OR_RETURN(annotate::AnnotatedCsv csv,
                     annotate::AnnotateCsv(job.input, job.output, options.existing, fixed, style, source, progress,
                                           total.has_value() ? &*total : nullptr));
    std::string text = absl::StrCat(" ", csv.summary.outcomes().Text(annotate::WithoutAzimuth(source.table())));
    nlohmann::ordered_json answers = csv.summary.Json();
    if (total.has_value()) {
      annotate::TotalPlan plan = total->plan;
      if (csv.took_divergence) plan.numbers.push_back(annotate::AssumedDivergence(*plan.divergence));
      text += csv.totals.Text(plan.options.coverage, options.style.s44_order.value_or(S44Order::k1b));
      if (const std::string water = annotate::WaterText(annotate::Parameters(plan)); !water.empty())
        absl::StrAppend(&text, "\n  ", water);
      for (const std::string& assumed : annotate::Assumptions(plan)) absl::StrAppend(&text, "\n  ", assumed);
      answers = annotate::WithTotal(std::move(answers), plan, csv.totals);
    }
    if (!csv.dialect.is_usual()) absl::StrAppend(&text, "\n  ", csv.dialect.Text(), ", in the output as well");
    return annotate::AnnotatedFile{std::move(csv.file),
                                   annotate::Findings{.input_bytes = csv.input_bytes,
                                                      .input = annotate::JsonBox(answerer.SeaJson()),
                                                      .answers = annotate::JsonBox(std::move(answers)),
                                                      .tally = csv.summary.Tally()},
                                   text + notes};
  };
  nlohmann::ordered_json parameters = CsvParameters(options, sea);
  parameters["sea_index"] = annotate::IndexOrUsual(settings.water);
  if (total.has_value()) {
    parameters["details"] = total->details;
    parameters["total"] = Parameters(total->plan);
  }
  RETURN_IF_ERROR(annotate::AnnotateFiles(
      jobs,
      {.command = "csv",
       .records = "pulses",
       .record = "pulse",
       .parameters = annotate::JsonBox(parameters),
       .files = files,
       .resume = options.files.resume,
       .existing = options.existing,
       .json = options.files.json,
       .annotate = annotate,
       .cause = {.axes = source.table().axes, .water_level = {}, .footprint_from_beam = IsFootprintFromBeam(fixed)}},
      source.table()));
  return FlushStandardOutput();
}

}  // namespace

void AddCsvCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<CsvOptions>();
  CLI::App* command = program.add_subcommand("csv",
                                             "Copy CSV files of pulses and append the uncertainty of each; "
                                             "columns are wind_speed, fetch, incidence, "
                                             "azimuth, footprint, depth, in any order, among others; "
                                             "beam_azimuth and wind_from may stand for azimuth, altitude "
                                             "and divergence for footprint; with a total also roll, "
                                             "pitch, heading, velocity_north and the like");
  AddFileOptions(*command, ".csv", options->files, options->existing);
  AddInputs(*command, options->fixed);
  AddSeaFlags(*command, options->flags, kRareSeaFlags);
  AddTotalFlags(*command, options->flags);
  AddFlags(*command, {"--details"}, group::kOutput, options->flags);
  AddSourceOptions(*command, options->source);
  AddStyleFlags(*command, options->flags, options->style);
  EndHelp(
      *command,
      absl::StrCat("A column that is missing can be given once for all pulses by its option.\n", kWhereAnswersComeFrom),
      "pulses.csv with_uncertainty.csv --wind-speed 5 --footprint 0.5",
      "surveys --output-dir annotated --recursive --resume --server 127.0.0.1:50051");
  command->callback([options, command, &run] { run = [options, command] { return RunCsv(*options, *command); }; });
}

}  // namespace albtpu::programs
