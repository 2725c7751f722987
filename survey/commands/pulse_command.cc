#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "command_line/help.h"
#include "command_line/standard_output.h"
#include "survey/commands/commands.h"
#include "survey/commands/options.h"
#include "survey/commands/pulse_text.h"
#include "survey/commands/survey_flags.h"
#include "survey/exit_status.h"
#include "survey/totals/plan_total.h"
#include "survey/totals/pulse_report.h"

namespace albtpu::client {
namespace {

struct PulseOptions {
  FixedInputs inputs;
  SurveyFlags flags;
  SourceOptions source;
  AnswerStyle style;
  PulseMotion motion;
  bool json = false;
};

// Adds the inputs that only a total takes, and a footprint from the divergence of the sensor.
absl::Status TakeForTotal(FixedInputs& inputs, PulseTotal& total) {
  if (!inputs[PulseInput::kAltitude].has_value())
    return UsageError("pulse: --altitude is missing; a total needs the height of the sensor above the water");
  total.altitude = *inputs[PulseInput::kAltitude];
  total.beam_azimuth = inputs[PulseInput::kBeamAzimuth];
  if (inputs[PulseInput::kFootprint].has_value()) {
    if (!inputs[PulseInput::kDivergence].has_value()) inputs[PulseInput::kAltitude].reset();
  } else if (const std::optional<double>& divergence = total.plan.divergence;
             divergence.has_value() && !inputs[PulseInput::kDivergence].has_value()) {
    inputs[PulseInput::kDivergence] = static_cast<float>(*divergence);
    total.plan.numbers.push_back(AssumedDivergence(*divergence));
  }
  // Over a table of winds a direction from north counts with that of the wind alone.
  if (inputs.any_sea) return absl::OkStatus();
  const std::optional<float>& wind_from = inputs[PulseInput::kWindFrom];
  if (wind_from.has_value()) total.plan.sea_axis = static_cast<float>(std::fmod(*wind_from + 540, 360));
  if (!wind_from.has_value()) inputs[PulseInput::kBeamAzimuth].reset();
  return absl::OkStatus();
}

absl::Status RunTotal(const PulseOptions& options, const AnswerStyle& style,
                      const config::SurveySettings& settings, FixedInputs inputs) {
  PulseTotal total;
  total.motion = options.motion;
  absl::StatusOr<TotalPlan> plan = PlanTotal(settings, ContextOf(settings, style.coverage));
  if (!plan.ok()) return plan.status();
  total.plan = *std::move(plan);
  if (absl::Status status = TakeForTotal(inputs, total); !status.ok()) return status;
  const absl::StatusOr<FixedCoordinates> coordinates = CoordinatesOf(inputs);
  if (!coordinates.ok()) return coordinates.status();
  absl::StatusOr<Answerer> answerer = Answerer::Open(settings.sea, options.source);
  if (!answerer.ok()) return answerer.status();
  if (absl::Status status = answerer->CheckOneTime("pulse"); !status.ok()) return status;
  const AnswerSource source = answerer->source();
  total.pulse = OnePulse(*coordinates);
  total.pulse.azimuths_from_north = inputs.any_sea && inputs[PulseInput::kBeamAzimuth].has_value();
  if (!inputs.any_sea) {
    const auto spectrum = source.table().attributes.find("spectrum");
    total.plan.wave_height =
        WaveHeightOfWind(inputs[PulseInput::kWindSpeed].value_or(0), inputs[PulseInput::kFetch],
                         spectrum != source.table().attributes.end() ? spectrum->second : "");
  }
  absl::StatusOr<nlohmann::ordered_json> json = TotalJson(total, source);
  if (!json.ok()) return json.status();
  json->update(answerer->SeaJson());
  std::cout << (options.json ? json->dump(2) + "\n" : TotalText(*json) + answerer->SeaText());
  return FlushStandardOutput();
}

absl::Status RunPulse(const PulseOptions& options) {
  const absl::StatusOr<config::SurveySettings> settings = SettingsOf(options.flags);
  if (!settings.ok()) return settings.status();
  if (absl::Status status = CheckTotalFlags(options.flags, *settings); !status.ok()) return status;
  AnswerStyle style = options.style;
  TakeStyle(settings->output, style);
  FixedInputs inputs = options.inputs;
  TakeWind(settings->sea, inputs);
  if (settings->wants_total()) return RunTotal(options, style, *settings, inputs);
  if (options.motion.attitude || options.motion.velocity || options.motion.rates)
    return UsageError(
        "pulse: --attitude, --velocity and --rates have no effect without --sensor; leave them out");
  const absl::StatusOr<FixedCoordinates> coordinates = CoordinatesOf(inputs);
  if (!coordinates.ok()) return coordinates.status();
  absl::StatusOr<Answerer> answerer = Answerer::Open(settings->sea, options.source);
  if (!answerer.ok()) return answerer.status();
  if (absl::Status status = answerer->CheckOneTime("pulse"); !status.ok()) return status;
  const bool from_north = inputs.any_sea && inputs[PulseInput::kBeamAzimuth].has_value();
  const AnswerSource source = answerer->source();
  const absl::StatusOr<PulseAnswer> answer = AskPulse(*coordinates, style, source, from_north);
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
  AddInputs(*command, options->inputs);
  AddSeaFlags(*command, options->flags, {});
  AddTotalFlags(*command, options->flags);
  AddTriple(*command, "--attitude", "ROLL,PITCH,HEADING", "Of the aircraft [degree]",
            options->motion.attitude);
  AddTriple(*command, "--velocity", "NORTH,EAST,DOWN", "Of the aircraft [m/s]", options->motion.velocity);
  AddTriple(*command, "--rates", "ROLL,PITCH,YAW", "Of the aircraft, about its own axes [degree/s]",
            options->motion.rates);
  AddSourceOptions(*command, options->source);
  AddStyleFlags(*command, options->flags, options->style);
  command->add_flag("--json", options->json, "Print one flat JSON object, with null where there is no number")
      ->group(group::kOutput);
  EndHelp(*command, kWhereAnswersComeFrom,
          "--wind-speed 7 --incidence 12 --footprint 0.5 --depth 8 --standard-errors",
          "--wind-speed 7 --fetch 20000 --incidence 12 --azimuth 30 --footprint 0.5 --depth 8 "
          "--server 127.0.0.1:50051 --json");
  command->callback([options, &run] { run = [options] { return RunPulse(*options); }; });
}

}  // namespace albtpu::client
