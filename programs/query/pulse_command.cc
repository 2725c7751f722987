#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "annotate/run/exit_status.h"
#include "annotate/totals/plan_total.h"
#include "annotate/totals/pulse_report.h"
#include "programs/command_line/help.h"
#include "programs/command_line/standard_output.h"
#include "programs/query/commands.h"
#include "programs/query/options.h"
#include "programs/query/pulse_text.h"
#include "programs/query/survey_flags.h"

namespace albtpu::programs {
namespace {

struct PulseOptions {
  annotate::FixedInputs inputs;
  SurveyFlags flags;
  SourceOptions source;
  annotate::AnswerStyle style;
  annotate::PulseMotion motion;
  bool json = false;
};

// Adds the inputs that only a total takes, and a footprint from the divergence of the sensor.
absl::Status TakeForTotal(annotate::FixedInputs& inputs, annotate::PulseTotal& total) {
  if (!inputs[annotate::PulseInput::kAltitude].has_value())
    return formats::UsageError(
        "pulse: --altitude is missing; a total needs the height of the sensor above the water");
  total.altitude = *inputs[annotate::PulseInput::kAltitude];
  total.beam_azimuth = inputs[annotate::PulseInput::kBeamAzimuth];
  if (inputs[annotate::PulseInput::kFootprint].has_value()) {
    if (!inputs[annotate::PulseInput::kDivergence].has_value())
      inputs[annotate::PulseInput::kAltitude].reset();
  } else if (const std::optional<double>& divergence = total.plan.divergence;
             divergence.has_value() && !inputs[annotate::PulseInput::kDivergence].has_value()) {
    inputs[annotate::PulseInput::kDivergence] = static_cast<float>(*divergence);
    total.plan.numbers.push_back(annotate::AssumedDivergence(*divergence));
  }
  // Over a table of winds a direction from north counts with that of the wind alone.
  if (inputs.any_sea) return absl::OkStatus();
  const std::optional<float>& wind_from = inputs[annotate::PulseInput::kWindFrom];
  if (wind_from.has_value()) total.plan.sea_axis = static_cast<float>(std::fmod(*wind_from + 540, 360));
  if (!wind_from.has_value()) inputs[annotate::PulseInput::kBeamAzimuth].reset();
  return absl::OkStatus();
}

absl::Status RunTotal(const PulseOptions& options, const annotate::AnswerStyle& style,
                      const config::SurveySettings& settings, annotate::FixedInputs inputs) {
  annotate::PulseTotal total;
  total.motion = options.motion;
  absl::StatusOr<annotate::TotalPlan> plan =
      annotate::PlanTotal(settings, annotate::ContextOf(settings, style.coverage));
  if (!plan.ok()) return plan.status();
  total.plan = *std::move(plan);
  if (absl::Status status = TakeForTotal(inputs, total); !status.ok()) return status;
  const absl::StatusOr<annotate::FixedCoordinates> coordinates = annotate::CoordinatesOf(inputs);
  if (!coordinates.ok()) return coordinates.status();
  absl::StatusOr<Answerer> answerer = Answerer::Open(settings.sea, options.source);
  if (!answerer.ok()) return answerer.status();
  if (absl::Status status = answerer->CheckOneTime("pulse"); !status.ok()) return status;
  const annotate::AnswerSource source = answerer->source();
  total.pulse = annotate::OnePulse(*coordinates);
  total.pulse.azimuths_from_north = inputs.any_sea && inputs[annotate::PulseInput::kBeamAzimuth].has_value();
  if (!inputs.any_sea) {
    const auto spectrum = source.table().attributes.find("spectrum");
    total.plan.wave_height = annotate::WaveHeightOfWind(
        inputs[annotate::PulseInput::kWindSpeed].value_or(0), inputs[annotate::PulseInput::kFetch],
        spectrum != source.table().attributes.end() ? spectrum->second : "");
  }
  absl::StatusOr<nlohmann::ordered_json> json = annotate::TotalJson(total, source);
  if (!json.ok()) return json.status();
  json->update(answerer->SeaJson());
  std::cout << (options.json ? json->dump(2) + "\n" : annotate::TotalText(*json) + answerer->SeaText());
  return FlushStandardOutput();
}

absl::Status RunPulse(const PulseOptions& options) {
  const absl::StatusOr<config::SurveySettings> settings = SettingsOf(options.flags);
  if (!settings.ok()) return settings.status();
  if (absl::Status status = CheckTotalFlags(options.flags, *settings); !status.ok()) return status;
  annotate::AnswerStyle style = options.style;
  TakeStyle(settings->output, style);
  annotate::FixedInputs inputs = options.inputs;
  TakeWind(settings->sea, inputs);
  if (settings->wants_total()) return RunTotal(options, style, *settings, inputs);
  if (options.motion.attitude || options.motion.velocity || options.motion.rates)
    return formats::UsageError(
        "pulse: --attitude, --velocity and --rates have no effect without --sensor; leave them out");
  const absl::StatusOr<annotate::FixedCoordinates> coordinates = annotate::CoordinatesOf(inputs);
  if (!coordinates.ok()) return coordinates.status();
  absl::StatusOr<Answerer> answerer = Answerer::Open(settings->sea, options.source);
  if (!answerer.ok()) return answerer.status();
  if (absl::Status status = answerer->CheckOneTime("pulse"); !status.ok()) return status;
  const bool from_north = inputs.any_sea && inputs[annotate::PulseInput::kBeamAzimuth].has_value();
  const annotate::AnswerSource source = answerer->source();
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

}  // namespace albtpu::programs
