#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "absl/strings/str_cat.h"
#include "command_line/help.h"
#include "command_line/standard_output.h"
#include "survey/commands/commands.h"
#include "survey/commands/options.h"
#include "survey/commands/pulse_text.h"
#include "survey/commands/sea_options.h"
#include "survey/exit_status.h"

namespace albtpu::client {
namespace {

struct PulseOptions {
  FixedInputs inputs;
  SeaOptions sea;
  SourceOptions source;
  AnswerStyle style;
  bool json = false;
};

absl::Status RunPulse(const PulseOptions& options) {
  const absl::StatusOr<SurveyDescription> survey = SurveyOf(options.sea);
  if (!survey.ok()) return survey.status();
  const absl::StatusOr<ToldSea> sea = ToldBy(options.sea, *survey);
  if (!sea.ok()) return sea.status();
  FixedInputs inputs = options.inputs;
  if (absl::Status status = TakeWind(*sea, inputs); !status.ok()) return status;
  const absl::StatusOr<FixedCoordinates> coordinates = CoordinatesOf(inputs);
  if (!coordinates.ok()) return coordinates.status();
  absl::StatusOr<Answerer> answerer = Answerer::Open(*sea, options.source);
  if (!answerer.ok()) return answerer.status();
  if (absl::Status status = answerer->CheckOneTime("pulse"); !status.ok()) return status;
  const bool from_north = inputs.any_sea && inputs[PulseInput::kBeamAzimuth].has_value();
  const AnswerSource source = answerer->source();
  const absl::StatusOr<PulseAnswer> answer = AskPulse(*coordinates, options.style, source, from_north);
  if (!answer.ok()) return answer.status();
  if (options.json) {
    std::cout << PulseJson(*answer, source.table(), answerer->SeaJson());
  } else {
    std::cout << PulseText(*answer, source.table(), answerer->SeaText());
  }
  return FlushStandardOutput();
}

}  // namespace

void AddPulseCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<PulseOptions>();
  CLI::App* command = program.add_subcommand("pulse", "Print the uncertainty of one pulse");
  for (const AxisId axis : kAxes) AddCoordinate(*command, axis, options->inputs.coordinates);
  AddBeamInputs(*command, options->inputs);
  AddSeaOptions(*command, options->sea);
  AddSourceOptions(*command, options->source);
  AddStyleOptions(*command, options->style);
  command->add_flag("--json", options->json, "Print one flat JSON object, with null where there is no number")
      ->group(group::kOutput);
  EndHelp(*command, kWhereAnswersComeFrom,
          "--wind-speed 7 --incidence 12 --footprint 0.5 --depth 8 --standard-errors",
          "--wind-speed 7 --fetch 20000 --incidence 12 --azimuth 30 --footprint 0.5 --depth 8 "
          "--server 127.0.0.1:50051 --json");
  command->callback([options, &run] { run = [options] { return RunPulse(*options); }; });
}

}  // namespace albtpu::client
