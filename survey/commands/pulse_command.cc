#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "survey/commands/commands.h"
#include "survey/commands/options.h"
#include "survey/commands/pulse_text.h"
#include "survey/exit_status.h"

namespace albtpu::client {
namespace {

struct PulseOptions {
  FixedCoordinates coordinates;
  SharedOptions shared;
  bool json = false;
};

absl::Status RunPulse(const PulseOptions& options) {
  for (const AxisId axis : kAxes) {
    if (options.coordinates[Index(axis)].has_value() || MayBeAbsent(axis)) continue;
    return UsageError(
        absl::StrCat("pulse: no ", FlagName(axis), ": give it in ", std::string(Describe(axis).units)));
  }
  const absl::StatusOr<std::unique_ptr<UncertaintySource>> source = OpenSource(options.shared.source);
  if (!source.ok()) return source.status();
  const absl::StatusOr<PulseAnswer> answer = AskPulse(options.coordinates, options.shared.style, **source);
  if (!answer.ok()) return answer.status();
  const TableSummary& table = (*source)->table();
  std::cout << (options.json ? PulseJson(*answer, table) : PulseText(*answer, table));
  return FlushAnswers();
}

}  // namespace

void AddPulseCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<PulseOptions>();
  CLI::App* command = program.add_subcommand("pulse", "Print the uncertainty of one pulse");
  for (const AxisId axis : kAxes) AddCoordinate(*command, axis, options->coordinates);
  command->add_flag("--json", options->json, "Print one flat JSON object, null where there is no number");
  AddSharedOptions(*command, options->shared);
  command->callback([options, &run] { run = [options] { return RunPulse(*options); }; });
}

}  // namespace albtpu::client
