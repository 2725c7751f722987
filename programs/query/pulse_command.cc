#include "programs/query/pulse_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "annotate/answers/answer_counts.h"
#include "annotate/answers/uncertainty_summary.h"
#include "annotate/run/file_progress.h"
#include "annotate/totals/plan_total.h"
#include "annotate/totals/pulse_report.h"
#include "formats/text/text.h"
#include "programs/command_line/command_line.h"
#include "programs/query/commands.h"
#include "programs/query/options.h"
#include "programs/query/survey_flags.h"
#include "status/status_macros.h"
#include "tables/s44.h"

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
    return formats::UsageError("pulse: --altitude is missing; a total needs the height of the sensor above the water");
  total.altitude = *inputs[annotate::PulseInput::kAltitude];
  total.beam_azimuth = inputs[annotate::PulseInput::kBeamAzimuth];
  if (inputs[annotate::PulseInput::kFootprint].has_value()) {
    if (!inputs[annotate::PulseInput::kDivergence].has_value()) inputs[annotate::PulseInput::kAltitude].reset();
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

absl::Status PrintTotal(const PulseOptions& options, annotate::PulseTotal& total,
                        const annotate::FixedCoordinates& coordinates, const annotate::FixedInputs& inputs,
                        bool from_north, Answerer& answerer) {
  const annotate::AnswerSource source = answerer.source();
  total.motion = options.motion;
  total.pulse = annotate::OnePulse(coordinates);
  total.pulse.azimuths_from_north = from_north;
  if (!inputs.any_sea) {
    total.plan.wave_height =
        annotate::WaveHeightOfWind(inputs[annotate::PulseInput::kWindSpeed].value_or(0),
                                   inputs[annotate::PulseInput::kFetch], annotate::SpectrumOf(source.table()));
  }
  ASSIGN_OR_RETURN(nlohmann::ordered_json json, annotate::TotalJson(total, source));
  json.update(answerer.SeaJson());
  const std::string sea = answerer.SeaText();
  std::cout << (options.json ? json.dump(2) : annotate::TotalText(json) + sea)
            << (options.json || !sea.empty() ? "\n" : "");
  return FlushStandardOutput();
}

absl::Status RunPulse(const PulseOptions& options) {
  ASSIGN_OR_RETURN(const config::SurveySettings settings, SettingsOf(options.flags));
  RETURN_IF_ERROR(CheckTotalFlags(options.flags, settings));
  annotate::AnswerStyle style = options.style;
  TakeStyle(settings.output, style);
  annotate::FixedInputs inputs = options.inputs;
  TakeWind(settings.sea, inputs);
  annotate::PulseTotal total;
  if (settings.wants_total()) {
    ASSIGN_OR_RETURN(total.plan, annotate::PlanTotal(settings, annotate::ContextOf(settings, style.coverage)));
    RETURN_IF_ERROR(TakeForTotal(inputs, total));
  } else if (options.motion.attitude || options.motion.velocity || options.motion.rates) {
    return formats::UsageError(
        "pulse: --attitude, --velocity and --rates have no effect without --sensor; leave them out");
  }
  ASSIGN_OR_RETURN(const annotate::FixedCoordinates coordinates, annotate::CoordinatesOf(inputs));
  ASSIGN_OR_RETURN(Answerer answerer,
                   Answerer::Open(settings.sea, options.source, annotate::IndexOrUsual(settings.water)));
  RETURN_IF_ERROR(answerer.CheckOneTime("pulse"));
  const bool from_north = inputs.any_sea && inputs[annotate::PulseInput::kBeamAzimuth].has_value();
  if (settings.wants_total()) return PrintTotal(options, total, coordinates, inputs, from_north, answerer);
  const annotate::AnswerSource source = answerer.source();
  ASSIGN_OR_RETURN(const PulseAnswer answer, AskPulse(coordinates, style, source, from_north));
  if (options.json)
    std::cout << PulseJson(answer, source.table(), answerer.SeaJson());
  else
    std::cout << PulseText(answer, source.table(), answerer.SeaText());
  return FlushStandardOutput();
}

using Json = nlohmann::ordered_json;

std::string CoordinateText(AxisId axis, std::optional<float> value, const client::TableSummary& table) {
  if (axis == AxisId::kFetch && std::isinf(value.value_or(INFINITY))) return "fully developed sea";
  if (!value.has_value()) return absl::StrCat("not given; ", std::string(annotate::WithoutAzimuth(table)));
  return absl::StrCat(formats::FormatFloat(*value), " ", std::string(Describe(axis).units));
}

// The coordinate of an axis. An azimuth from north is stated from downwind, as others are.
std::optional<float> Stated(AxisId axis, const PulseAnswer& answer, const client::TableSummary& table) {
  const std::optional<float>& value = answer.pulse[Index(axis)];
  if (axis != AxisId::kAzimuth || !value.has_value() || !answer.azimuth_from_north) return value;
  const double azimuth = *value - table.sea->x_azimuth;
  return static_cast<float>(azimuth < -180 ? azimuth + 360 : azimuth);
}

std::string Line(std::string_view label, std::string_view text) {
  return absl::StrFormat("%-24s %s\n", std::string(label), std::string(text));
}

std::string ValueText(Quantity quantity, const PulseAnswer& answer) {
  const annotate::AnswerStyle& style = answer.style;
  const float value = answer.stated[quantity][0];
  if (!std::isfinite(value)) return "not in this table";
  std::string text = absl::StrFormat("%.6g", value);
  if (style.standard_errors) {
    const float error = answer.stated.standard_errors[Index(quantity)][0];
    absl::StrAppend(&text, std::isfinite(error) ? absl::StrFormat(" +- %.2g", error) : " (standard error not known)");
  }
  absl::StrAppend(&text, " ", std::string(Describe(quantity).units));
  if (Describe(quantity).is_bias) return text + ", mean";
  return absl::StrCat(text, ", ", annotate::CoverageText(style.coverage));
}

// The part of a limit that remains for all other sources of uncertainty.
std::string RemainderText(double limit, double surface) {
  const std::optional<double> left = RemainingBudget(limit, surface);
  return left.has_value() ? absl::StrFormat("%.3f m", *left) : "exceeded";
}

std::string InterpolationErrorText(const client::TableSummary& table) {
  const std::vector<annotate::InterpolationError> errors = annotate::InterpolationErrors(table);
  if (errors.empty()) return Line("interpolation error", "not known (the table does not state it)");
  std::string text = Line("interpolation error", "relative, at random pulses all over the table:");
  for (const annotate::InterpolationError& error : errors)
    text += Line(absl::StrCat("  ", std::string(Describe(error.quantity).name)), annotate::Text(error));
  return text;
}

std::string S44Text(const PulseAnswer& answer) {
  const double thu = answer.p95[Quantity::kThu][0], tvu = answer.p95[Quantity::kTvu][0];
  const double depth = *answer.pulse[Index(AxisId::kDepth)];
  const std::uint8_t best = answer.p95.best_s44_orders[0];
  std::string text = absl::StrFormat("\n%s, all at 95 %%: the sea surface alone has THU %.6g m, TVU %.6g m\n",
                                     std::string(kS44Edition), thu, tvu);
  absl::StrAppend(
      &text, "best order left open: ", best > 0 ? std::string(Name(kS44Orders[best - 1])) : "none", "\n",
      absl::StrFormat("%-12s %12s %12s %26s\n", "order", "THU limit", "TVU limit", "left for all else: THU, TVU"));
  for (const S44Order order : kS44Orders) {
    if (answer.style.s44_order.value_or(order) != order) continue;
    const double thu_limit = ThuLimit(order, depth), tvu_limit = TvuLimit(order, depth);
    absl::StrAppend(&text, absl::StrFormat("%-12s %10.3f m %10.3f m %13s %13s\n", std::string(Name(order)), thu_limit,
                                           tvu_limit, RemainderText(thu_limit, thu), RemainderText(tvu_limit, tvu)));
  }
  return text;
}

// Null where the table does not state it.
void AddInterpolationErrors(const client::TableSummary& table, Json& object) {
  const std::vector<annotate::InterpolationError> errors = annotate::InterpolationErrors(table);
  for (const Quantity quantity : kQuantities) {
    if (Describe(quantity).is_bias) continue;  // They pass through zero: a relative error has no meaning.
    const auto error = std::find_if(errors.begin(), errors.end(), [quantity](const annotate::InterpolationError& e) {
      return e.quantity == quantity;
    });
    const std::string name = absl::StrCat(std::string(Describe(quantity).name), "_interpolation_error_");
    object[name + "rms"] = error == errors.end() ? Json() : Json(error->rms);
    object[name + "percentile_99"] = error == errors.end() ? Json() : Json(error->percentile_99);
  }
}

std::string WhyNoNumber(const annotate::AnswerBatch& answer, const client::TableSummary& table) {
  const std::uint8_t number = answer.outcome_axes[0];
  if (number == 0) return "no number";
  const AxisSchema& axis = Describe(kAxes[number - 1]);
  const client::AxisRange& range = table.axes[number - 1];
  return absl::StrFormat("no number (the table covers %s from %g to %g %s)", std::string(axis.name), range.first,
                         range.last, std::string(axis.units));
}

}  // namespace

void AddPulseCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<PulseOptions>();
  CLI::App* command = program.add_subcommand("pulse", "Print the uncertainty of one pulse");
  AddInputs(*command, options->inputs);
  AddSeaFlags(*command, options->flags, {});
  AddTotalFlags(*command, options->flags);
  AddTriple(*command, "--attitude", "ROLL,PITCH,HEADING", "Of the aircraft [degree]", options->motion.attitude);
  AddTriple(*command, "--velocity", "NORTH,EAST,DOWN", "Of the aircraft [m/s]", options->motion.velocity);
  AddTriple(*command, "--rates", "ROLL,PITCH,YAW", "Of the aircraft, about its own axes [degree/s]",
            options->motion.rates);
  AddSourceOptions(*command, options->source);
  AddStyleFlags(*command, options->flags, options->style);
  command->add_flag("--json", options->json, "Print one flat JSON object, with null where there is no number")
      ->group(group::kOutput);
  EndHelp(*command, kWhereAnswersComeFrom, "--wind-speed 7 --incidence 12 --footprint 0.5 --depth 8 --standard-errors",
          "--wind-speed 7 --fetch 20000 --incidence 12 --azimuth 30 --footprint 0.5 --depth 8 "
          "--server 127.0.0.1:50051 --json");
  command->callback([options, &run] { run = [options] { return RunPulse(*options); }; });
}

absl::StatusOr<PulseAnswer> AskPulse(const annotate::FixedCoordinates& pulse, annotate::AnswerStyle style,
                                     const annotate::AnswerSource& source, bool azimuth_from_north) {
  PulseAnswer answer{.pulse = pulse, .azimuth_from_north = azimuth_from_north, .style = style, .stated = {}, .p95 = {}};
  annotate::PulseBatch batch = annotate::OnePulse(pulse);
  batch.azimuths_from_north = azimuth_from_north;
  annotate::AnswerSelection surface;
  annotate::UncertaintySummary::Select(surface);
  RETURN_IF_ERROR(
      annotate::AnswerPulses(source, style.query(), batch, annotate::AnswerCells(style).selection(), answer.stated));
  RETURN_IF_ERROR(
      annotate::AnswerPulses(source, {.coverage = Coverage::kP95, .s44_order = {}}, batch, surface, answer.p95));
  return answer;
}

namespace {

std::string WaterText(const client::TableSummary& table) {
  const auto made = table.attributes.find("refractive_index");
  const std::string index = absl::StrCat(table.refractive_index);
  std::string text = absl::StrCat("refractive index ", index);
  if (made == table.attributes.end())
    absl::StrAppend(&text, "; the table states none: ", kRefractiveIndex, " is assumed");
  else if (made->second != index)
    absl::StrAppend(&text, ", scaled from ", made->second);
  return text;
}

}  // namespace

std::string PulseText(const PulseAnswer& answer, const client::TableSummary& table, const std::string& sea) {
  std::string text =
      Line("table", absl::StrCat(table.id, " ", table.version, ": ", table.title)) + Line("digest", table.digest);
  text += Line("water", WaterText(table));
  if (!sea.empty()) text += absl::StrCat("the sea", sea, "\n");
  for (const AxisId axis : kAxes) {
    if (!sea.empty() && annotate::IsOfSea(annotate::InputOf(axis))) continue;
    text += Line(Describe(axis).name, CoordinateText(axis, Stated(axis, answer, table), table));
  }
  text += Line("outcome", annotate::OutcomeName(answer.stated, 0));
  if (!answer.stated.interpolated(0)) return text + WhyNoNumber(answer.stated, table) + "\n";
  for (const Quantity quantity : kQuantities) text += Line(Describe(quantity).name, ValueText(quantity, answer));
  if (!table.sea.has_value()) text += InterpolationErrorText(table);
  return text + S44Text(answer);
}

std::string PulseJson(const PulseAnswer& answer, const client::TableSummary& table, const Json& sea) {
  Json object;
  for (const AxisId axis : kAxes) {
    const std::optional<float> value = Stated(axis, answer, table);
    object[std::string(Describe(axis).name)] = value.has_value() ? formats::JsonNumber(*value) : Json();
  }
  const annotate::AnswerCells cells(answer.style);
  auto name = cells.names().begin();
  cells.Visit(
      answer.stated, 0, [&](float number) { object[*name++] = formats::JsonNumber(number); },
      [&](std::string_view cell) { object[*name++] = cell; }, [&] { object[*name++] = nullptr; });
  object["azimuth_absent"] = !answer.pulse[Index(AxisId::kAzimuth)].has_value();
  object["table"] = table.id;
  object["version"] = table.version;
  object["digest"] = table.digest;
  object["refractive_index"] = table.refractive_index;
  object["coverage"] = annotate::CoverageName(answer.style.coverage);
  AddInterpolationErrors(table, object);
  object.update(sea);
  return object.dump(2) + "\n";
}

}  // namespace albtpu::programs
