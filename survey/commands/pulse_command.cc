#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "command_line/help.h"
#include "command_line/standard_output.h"
#include "survey/commands/commands.h"
#include "survey/commands/options.h"
#include "survey/commands/pulse_text.h"
#include "survey/exit_status.h"

namespace albtpu::client {
namespace {

struct PulseOptions {
  FixedInputs inputs;
  SourceOptions source;
  AnswerStyle style;
  bool json = false;
};

absl::Status RunPulse(const PulseOptions& options) {
  const absl::StatusOr<FixedCoordinates> coordinates = CoordinatesOf(options.inputs);
  if (!coordinates.ok()) return coordinates.status();
  const absl::StatusOr<std::unique_ptr<UncertaintySource>> source = OpenSource(options.source);
  if (!source.ok()) return source.status();
  const absl::StatusOr<PulseAnswer> answer = AskPulse(*coordinates, options.style, **source);
  if (!answer.ok()) return answer.status();
  const TableSummary& table = (*source)->table();
  std::cout << (options.json ? PulseJson(*answer, table) : PulseText(*answer, table));
  return FlushStandardOutput();
}

}  // namespace

void AddPulseCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<PulseOptions>();
  CLI::App* command = program.add_subcommand("pulse", "Print the uncertainty of one pulse");
  for (const AxisId axis : kAxes) AddCoordinate(*command, axis, options->inputs.coordinates);
  AddBeamInputs(*command, options->inputs);
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
