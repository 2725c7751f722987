#include "annotate/totals/plan_total.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "annotate/run/file_progress.h"
#include "config/sensors/sensor.h"
#include "config/survey_draft.h"
#include "sea/sea_state.h"
#include "sea/spectra/spectrum_moments.h"
#include "status/status_macros.h"

namespace albtpu::annotate {
StatedNumber AssumedDivergence(double milliradians) {
  return {"divergence", absl::StrCat(milliradians, " mrad"), "assumed: the default of the sensor", true};
}

nlohmann::ordered_json Parameters(const TotalPlan& plan) {
  nlohmann::ordered_json json;
  json["located"] = std::string(kSurfaceLocationNames[static_cast<std::size_t>(plan.options.located)]);
  for (const StatedNumber& number : plan.numbers)
    json["numbers"][number.name] = {{"value", number.value}, {"source", number.source}, {"assumed", number.assumed}};
  return json;
}

std::vector<std::string> Assumptions(const TotalPlan& plan) {
  std::vector<std::string> lines;
  for (const StatedNumber& number : plan.numbers)
    if (number.assumed) lines.push_back(absl::StrCat(number.name, " ", number.value, " (", number.source, ")"));
  if (plan.water.channel_assumed)
    lines.push_back(absl::StrCat("returns from the surface lie on it (assumed: [surface] channel is not given",
                                 plan.water.lasers, ")"));
  return lines;
}

std::string WaterText(const nlohmann::ordered_json& parameters) {
  const nlohmann::ordered_json& numbers = parameters["numbers"];
  if (numbers.contains("water_column")) return "water column: left out, so that totals lack its share";
  const auto entered = numbers.find("water_entered"), became = numbers.find("water_attenuation");
  if (entered == numbers.end() || became == numbers.end()) return "";
  const auto text = [](const nlohmann::ordered_json& number, const char* part) {
    return number[part].get<std::string>();
  };
  return absl::StrCat("water: ", text(*entered, "value"), "; attenuation ", text(*became, "value"), " (",
                      text(*became, "source"), ")");
}

namespace {

// Of the index: by refractive_index.h 0.9e-4 for a degree and 1.9e-4 for a salinity of 1.
constexpr double kIndexOfState = 0.0002;

std::string Text(std::span<const double> numbers, std::string_view unit) {
  return absl::StrCat(absl::StrJoin(numbers, ", "), unit == "1" ? "" : " ", unit == "1" ? "" : std::string(unit));
}

// Takes each standard deviation from the user, else from the trajectory pulse by pulse, else from the sensor, else what
// is assumed; and states which.
class ErrorPlan {
 public:
  ErrorPlan(const config::SurveySettings& survey, const TotalContext& context, const config::Sensor& sensor,
            bool index_of_state, TotalPlan& plan)
      : given_(survey.sigma),
        trajectory_errors_(context.trajectory_errors),
        sensor_(sensor),
        index_of_state_(index_of_state),
        plan_(plan) {}

  absl::Status Make() {
    const SurfaceLocation located = plan_.options.located;
    const bool range_given = given_.Has(&AirErrors::surface_range),
               height_given = given_.Has(&AirErrors::surface_height);
    if (range_given && (height_given || located == SurfaceLocation::kLevel)) {
      return formats::UsageError(
          absl::StrCat("[sigma] surface_range has no effect ",
                       height_given ? "beside surface_height" : "where a level locates the surface",
                       " (one of them is how well the surface was located); leave it out"));
    }
    const bool own_return = located == SurfaceLocation::kPulse && !height_given;
    for (std::size_t i = 0; i < kErrorSourceCount; ++i) {
      const ErrorSource& source = kErrorSources[i];
      if (source.Is(&AirErrors::surface_range) ? own_return : !own_return || !source.Is(&AirErrors::surface_height))
        Take(i);
    }
    plan_.hard_range = OneReturn();
    return absl::OkStatus();
  }

 private:
  void Take(std::size_t i) {
    const ErrorSource& source = kErrorSources[i];
    const auto take = [&](const AirErrors& from, const std::string& origin, bool assumed) {
      std::ranges::copy(source.In(from), source.In(plan_.options.errors).begin());
      plan_.numbers.push_back({std::string(source.name), Text(source.In(from), source.unit), origin, assumed});
    };
    const auto [assumed, why] = Assumed(source);
    bool* const by_pulse = source.Is(&AirErrors::position)   ? &plan_.position_by_pulse
                           : source.Is(&AirErrors::attitude) ? &plan_.attitude_by_pulse
                                                             : nullptr;
    if (given_.stated[i]) return take(given_.values, "[sigma]", false);
    if (by_pulse != nullptr && !trajectory_errors_.empty()) {
      *by_pulse = true;
      std::ranges::copy(source.In(assumed), source.In(plan_.options.errors).begin());
      plan_.numbers.push_back({std::string(source.name), "pulse by pulse", trajectory_errors_, false});
      return;
    }
    if (sensor_.errors.stated[i])
      return take(sensor_.errors.values, absl::StrCat(sensor_.name, ": ", sensor_.origins[i]), false);
    assert(!why.empty());  // Otherwise UndecidedOf() has it.
    take(assumed, absl::StrCat("assumed: ", why), true);
  }

  // m, of the range of a return from a surface.
  double OneReturn() const {
    return given_.Has(&AirErrors::surface_range)           ? given_.values.surface_range
           : sensor_.errors.Has(&AirErrors::surface_range) ? sensor_.errors.values.surface_range
                                                           : plan_.options.errors.bottom_range;
  }

  // The numbers of a source that nothing states, and why they stand for it.
  std::pair<AirErrors, std::string> Assumed(const ErrorSource& source) const {
    AirErrors assumed;
    std::copy_n(source.assumed.begin(), source.size(), source.In(assumed).begin());
    if (source.Is(&AirErrors::surface_range)) assumed.surface_range = OneReturn();
    if (source.Is(&AirErrors::surface_height) && plan_.options.located != SurfaceLocation::kLevel) {
      assumed.surface_height = OneReturn();
      return {assumed, "no better than one return"};
    }
    if (source.Is(&AirErrors::index) && index_of_state_) {
      assumed.index = kIndexOfState;
      return {assumed, "temperature and salinity within 1 degree and 1"};
    }
    return {assumed, std::string(source.assumption)};
  }

  const config::StatedErrors given_;
  const std::string& trajectory_errors_;
  const config::Sensor& sensor_;
  bool index_of_state_;
  TotalPlan& plan_;
};

// "scan (degree)" of the sources that neither the user nor the sensor states, and for which nothing can be assumed.
std::vector<std::string> MissingNumbers(const config::StatedErrors& given, const config::Sensor& sensor) {
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < kErrorSourceCount; ++i) {
    const ErrorSource& source = kErrorSources[i];
    if (source.assumption.empty() && !given.stated[i] && !sensor.errors.stated[i])
      missing.push_back(absl::StrCat(std::string(source.name), " (", std::string(source.unit), ")"));
  }
  return missing;
}

// "[datum] mcu 0.226 m at 95%, VDatum region Washington - Puget Sound"
std::string SourceOf(const config::DatumSettings& datum) {
  return absl::StrCat("[datum]",
                      datum.mcu.has_value() ? absl::StrCat(" mcu ", *datum.mcu, " m at ", *datum.confidence) : "",
                      datum.region.has_value() ? absl::StrCat(", VDatum region ", *datum.region) : "");
}

// Requires that something says it: UndecidedOf() has it otherwise.
absl::StatusOr<SurfaceLocation> LocationOf(const config::SurfaceSettings& surface, const TotalContext& context) {
  if (surface.located.has_value()) {
    const auto found = std::find(kSurfaceLocationNames.begin(), kSurfaceLocationNames.end(), *surface.located);
    const auto located = static_cast<SurfaceLocation>(found - kSurfaceLocationNames.begin());
    if (located == SurfaceLocation::kLevel || context.has_surface_returns || !context.has_level) return located;
    return formats::UsageError(
        absl::StrCat("[surface] located = \"", *surface.located,
                     "\" needs returns from the surface, but only a level is given; give their classes, or "
                     "located = \"level\""));
  }
  return context.has_surface_returns ? SurfaceLocation::kLocal : SurfaceLocation::kLevel;
}

}  // namespace

TotalContext ContextOf(const config::SurveySettings& survey, Coverage coverage) {
  const config::SurfaceSettings& surface = survey.surface;
  return {.coverage = coverage,
          .has_surface_returns = !surface.classes.empty() || surface.located.has_value(),
          .has_level = surface.level.has_value()};
}

std::vector<config::OpenDecision> UndecidedOf(const config::SurveySettings& survey, const TotalContext& context) {
  std::vector<config::OpenDecision> open;
  if (!survey.datum.standard_deviation().has_value()) {
    open.push_back({"datum",
                    "the uncertainty of the vertical datum is not decided, so that no number may be called total; give "
                    "[datum] sigma in m, 1 sigma (0 for ellipsoidal heights), or mcu with its confidence"});
  }
  if (!survey.water.without_column() && !survey.water.bias.has_value()) {
    open.push_back(
        {"water",
         "the contribution of the water column is not decided, so that no number may be called total; give [water] "
         "bias = \"none\" (it is in the points), \"correct\", \"vendor\" or \"calibrated\" with the optics "
         "of the water and the receiver, or column = \"none\" to leave it out"});
  }
  if (!survey.surface.located.has_value() && !context.has_surface_returns && !context.has_level) {
    open.push_back(
        {"surface",
         "nothing says how the surface was located when the points were made; give [surface] located = "
         "\"pulse\" (by the return of each pulse), \"local\" (by a model of these returns) or \"level\" (by a "
         "water level)"});
  }
  if (!survey.sensor.name.has_value()) return open;
  const absl::StatusOr<config::Sensor> sensor = config::FindSensor(*survey.sensor.name);
  if (!sensor.ok()) return open;
  if (const std::vector<std::string> missing = MissingNumbers(survey.sigma, *sensor); !missing.empty()) {
    open.push_back({"sigma", absl::StrCat("no source gives ", absl::StrJoin(missing, " and "), " of ", sensor->title,
                                          "; state it under [sigma] in the survey file")});
  }
  return open;
}

namespace {

// What to think of a surface of which nobody says by which laser it was located. It follows the word "given".
std::string LasersOf(const config::Sensor& sensor) {
  if (!sensor.surface_channel.has_value()) return "";
  if (sensor.surface_channel->value == "infrared") return absl::StrCat(", ", sensor.title, " has an infrared laser");
  return absl::StrCat("; ", sensor.title,
                      " has no infrared laser, and a green one finds the surface too low: where the processing did not "
                      "correct this, give [surface] channel = \"green\"");
}

}  // namespace

absl::StatusOr<TotalPlan> PlanTotal(const config::SurveySettings& survey, const TotalContext& context) {
  if (!survey.sensor.name.has_value()) {
    return formats::UsageError(
        "[[sensor.channel]] names several sensors (of which only points of LAS files have one each); name one by "
        "--sensor");
  }
  ASSIGN_OR_RETURN(const config::Sensor sensor, config::FindSensor(*survey.sensor.name));
  const std::vector<config::OpenDecision> open = UndecidedOf(survey, context);
  if (!open.empty()) return formats::UsageError(open.front().message);
  ASSIGN_OR_RETURN(const SurfaceLocation located, LocationOf(survey.surface, context));
  TotalPlan plan;
  BudgetOptions& options = plan.options;
  options.located = located;
  options.coverage = context.coverage;
  const auto state = [&](const char* name, const std::string& value, const std::string& source, bool assumed) {
    plan.numbers.push_back({name, value, source, assumed});
  };
  state("sensor", sensor.title, sensor.name, false);
  if (sensor.divergence.has_value()) plan.divergence = sensor.divergence->value;

  const config::WaterSettings& water = survey.water;
  const std::optional<double> of_water = IndexOf(water);
  const bool by_state = of_water.has_value() && !water.index.has_value();
  RETURN_IF_ERROR(ErrorPlan(survey, context, sensor, by_state, plan).Make());
  options.index = of_water.value_or(options.index);
  state("refractive_index", absl::StrCat(options.index),
        !of_water.has_value() ? "assumed: sea water at 532 nm"
        : by_state            ? "temperature and salinity of [water], 532 nm"
                              : "the user",
        !of_water.has_value());
  const std::optional<config::Triple>& arm = survey.sensor.lever_arm;
  options.lever_arm = arm.value_or(config::Triple{});
  state("lever_arm_vector", Text(options.lever_arm, "m"), arm.has_value() ? "the user" : "assumed: none",
        !arm.has_value());
  options.datum = *survey.datum.standard_deviation();
  state("datum", absl::StrCat(options.datum, " m"), SourceOf(survey.datum), false);
  options.extra_horizontal = survey.extra.horizontal.value_or(0);
  options.extra_vertical = survey.extra.vertical.value_or(0);
  if (survey.extra.horizontal.has_value())
    state("extra_horizontal", absl::StrCat(options.extra_horizontal, " m"), "[extra], radial", false);
  if (survey.extra.vertical.has_value())
    state("extra_vertical", absl::StrCat(options.extra_vertical, " m"), "[extra]", false);
  ASSIGN_OR_RETURN(plan.water, PlanWater(water, options.index, plan.numbers));
  RETURN_IF_ERROR(PlanGreenSurface(survey, options, plan.water, plan.numbers));
  plan.water.lasers = LasersOf(sensor);
  return plan;
}

void TakeErrorsOfTrajectory(std::string_view source, TotalPlan& plan) {
  const auto number = std::ranges::find(plan.numbers, source, &StatedNumber::name);
  if (number == plan.numbers.end() || number->source == "[sigma]") return;
  const bool position = source == kErrorSources[Index(&AirErrors::position)].name;
  (position ? plan.position_by_pulse : plan.attitude_by_pulse) = true;
  *number = {number->name, "pulse by pulse", "the trajectory", false};
}

std::string SpectrumOf(const client::TableSummary& table) {
  const auto found = table.attributes.find("spectrum");
  return found != table.attributes.end() ? found->second : "";
}

float WaveHeightOfWind(double wind_speed, std::optional<float> fetch, const std::string& spectrum) {
  if (wind_speed <= 0) return 0;
  const WindSea sea{.wind_speed_10m = wind_speed,
                    .fetch = fetch.has_value() ? *fetch : std::numeric_limits<double>::infinity(),
                    .model = &SpectrumModelNamed(spectrum)};
  return static_cast<float>(std::sqrt(ElevationVariance(Sampled(*sea.MakeSpectrum(), SeaWavenumbers(), 1))));
}

}  // namespace albtpu::annotate
