#include "survey/totals/plan_total.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "sea/spectra/spectrum_moments.h"
#include "sea/wave_state.h"
#include "survey/exit_status.h"
#include "survey/sensors/installed_sensors.h"

namespace albtpu::client {
namespace {

// What is assumed where nothing else is known, 1 sigma: a well calibrated system with a good trajectory, as
// post-processed GNSS and inertial navigation of airborne surveys state it (data sheets of Applanix AP and POS AV,
// PPK).
constexpr config::Triple kPosition = {0.02, 0.02, 0.06};      // m
constexpr config::Triple kAttitude = {0.005, 0.005, 0.008};   // degree
constexpr config::Triple kBoresight = {0.001, 0.001, 0.004};  // degree
constexpr double kLeverArm = 0.02;                            // m
constexpr double kTime = 1e-5;                                // s
constexpr double kLevel = 0.05;  // m; of a water level of a gauge or a tide model near by.
// Sea water of 5 to 30 degrees C and salinities of 25 to 38 has 1.337 to 1.344 at 532 nm (Quan and Fry 1995).
constexpr double kIndex = 0.002;
// By refractive_index.h: 0.9e-4 for a degree and 1.9e-4 for a salinity of 1.
constexpr double kIndexOfState = 0.0002;

std::string Text(double value) { return absl::StrCat(value); }
std::string Text(const config::Triple& value) { return absl::StrJoin(value, ", "); }

// Collects the numbers of the plan with their sources.
class Numbers {
 public:
  Numbers(const Sensor& sensor, TotalPlan& plan) : sensor_(sensor), plan_(plan) {}

  // The user's number, else the sensor's, else what is assumed, which says why; else a problem.
  template <typename Value, typename Sourced>
  Value Choose(const char* key, const char* unit, const std::optional<Value>& told,
               const std::optional<Sourced>& sourced, const std::optional<Value>& assumed,
               const std::string& why) {
    const auto take = [&](const Value& value, const std::string& source, bool is_assumed) {
      plan_.numbers.push_back(
          {key, absl::StrCat(Text(value), *unit == '\0' ? "" : " ", unit), source, is_assumed});
      return value;
    };
    if (told.has_value()) return take(*told, "[sigma]", false);
    if (sourced.has_value())
      return take(sourced->value, absl::StrCat(sensor_.name, ": ", sourced->source), false);
    if (assumed.has_value()) return take(*assumed, why, true);
    missing_.push_back(absl::StrCat(key, " (", unit, ")"));
    return {};
  }
  template <typename Value>
  Value Choose(const char* key, const char* unit, const std::optional<Value>& told, const Value& assumed,
               const std::string& why) {
    return Choose(key, unit, told, std::optional<SourcedNumberOr<Value>>(), std::optional<Value>(assumed),
                  why);
  }

  absl::Status status() const {
    if (missing_.empty()) return absl::OkStatus();
    return UsageError(absl::StrCat("no source gives ", absl::StrJoin(missing_, " and "), " of ",
                                   sensor_.title, "; state it under [sigma] in the survey file"));
  }

 private:
  template <typename Value>
  struct SourcedNumberOr {
    Value value;
    std::string source;
  };

  const Sensor& sensor_;
  TotalPlan& plan_;
  std::vector<std::string> missing_;
};

absl::StatusOr<SurfaceLocation> LocationOf(const config::SurfaceSettings& surface,
                                           const TotalContext& context) {
  if (surface.located.has_value()) {
    const auto found =
        std::find(kSurfaceLocationNames.begin(), kSurfaceLocationNames.end(), *surface.located);
    const auto located = static_cast<SurfaceLocation>(found - kSurfaceLocationNames.begin());
    if (located == SurfaceLocation::kLevel || context.has_surface_returns || !context.has_level)
      return located;
    return UsageError(
        absl::StrCat("[surface] located = \"", *surface.located,
                     "\" needs returns from the surface, but only a level is given; give their classes, or "
                     "located = \"level\""));
  }
  if (context.has_surface_returns) return SurfaceLocation::kLocal;
  if (context.has_level) return SurfaceLocation::kLevel;
  return UsageError(
      "nothing says how the surface was located when the points were made; give [surface] located = "
      "\"pulse\" (by the "
      "return of each pulse), \"local\" (by a model of these returns) or \"level\" (by a water level)");
}

absl::Status CheckDecided(const config::SurveySettings& survey) {
  if (!survey.datum.sigma.has_value()) {
    return UsageError(
        "the uncertainty of the vertical datum is not decided, so that no number may be called total; give "
        "[datum] sigma "
        "in m, 1 sigma (0 for ellipsoidal heights)");
  }
  if (survey.water.without_column() || survey.water.bias.has_value()) return absl::OkStatus();
  return UsageError(
      "the share of the water column is not decided, so that no number may be called total; give [water] "
      "bias = "
      "\"none\" (it is in the points), \"correct\", \"vendor\" or \"calibrated\" with the optics of the "
      "water and "
      "the receiver, or column = \"none\" to leave it out");
}

}  // namespace

absl::StatusOr<TotalPlan> PlanTotal(const config::SurveySettings& survey, const TotalContext& context) {
  if (context.decided)
    if (absl::Status status = CheckDecided(survey); !status.ok()) return status;
  const absl::StatusOr<Sensor> sensor = FindSensor(*survey.sensor.name);
  if (!sensor.ok()) return sensor.status();
  const absl::StatusOr<SurfaceLocation> located = LocationOf(survey.surface, context);
  if (!located.ok()) return located.status();
  TotalPlan plan;
  BudgetOptions& options = plan.options;
  options.located = *located;
  options.coverage = context.coverage;
  const auto state = [&](const char* name, const std::string& value, const std::string& source,
                         bool assumed) {
    plan.numbers.push_back({name, value, source, assumed});
  };
  state("sensor", sensor->title, sensor->name, false);

  const config::ToldSigma told = survey.sigma.value_or(config::ToldSigma());
  AirErrors& errors = options.errors;
  Numbers numbers(*sensor, plan);
  const std::string good = "assumed: a good post-processed trajectory";
  plan.position_by_pulse = !context.trajectory_errors.empty() && !told.position.has_value();
  plan.attitude_by_pulse = !context.trajectory_errors.empty() && !told.attitude.has_value();
  if (plan.position_by_pulse) {
    errors.position = kPosition;
    state("position", "pulse by pulse", context.trajectory_errors, false);
  } else {
    errors.position = numbers.Choose("position", "m", told.position, sensor->position, {kPosition}, good);
  }
  if (plan.attitude_by_pulse) {
    errors.attitude = kAttitude;
    state("attitude", "pulse by pulse", context.trajectory_errors, false);
  } else {
    errors.attitude =
        numbers.Choose("attitude", "degree", told.attitude, sensor->attitude, {kAttitude}, good);
  }
  errors.boresight = numbers.Choose("boresight", "degree", told.boresight, sensor->boresight, {kBoresight},
                                    "assumed: a good calibration");
  errors.lever_arm = numbers.Choose("lever_arm", "m", told.lever_arm, sensor->lever_arm, {kLeverArm},
                                    "assumed: a good survey of it");
  errors.scan = numbers.Choose("scan", "degree", told.scan, sensor->scan, {}, "");
  errors.time =
      numbers.Choose("time", "s", told.time, sensor->time, {kTime}, "assumed: hardware time stamps");
  errors.range_offset = numbers.Choose("range_offset", "m", told.range_offset, sensor->range_offset, {0.0},
                                       "assumed: calibrated");
  errors.bottom_range = numbers.Choose("bottom_range", "m", told.bottom_range, sensor->bottom_range, {}, "");
  if (absl::Status status = numbers.status(); !status.ok()) return status;
  const double return_range =
      sensor->surface_range.has_value() ? sensor->surface_range->value : errors.bottom_range;
  if (*located == SurfaceLocation::kPulse && !told.surface_height.has_value()) {
    errors.surface_range =
        numbers.Choose("surface_range", "m", std::optional<double>(), sensor->surface_range, {return_range},
                       "assumed: as good as the range to the bottom");
  } else {
    const bool level = *located == SurfaceLocation::kLevel;
    errors.surface_height = numbers.Choose(
        "surface_height", "m", told.surface_height, level ? kLevel : return_range,
        level ? "assumed: a gauge or tide model near by" : "assumed: no better than one return");
  }
  const config::WaterSettings& water = survey.water;
  const std::optional<double> of_water = IndexOf(water);
  const bool by_state = of_water.has_value() && !water.index.has_value();
  errors.index = numbers.Choose("index", "", told.index, by_state ? kIndexOfState : kIndex,
                                by_state ? "assumed: temperature and salinity within 1 degree and 1"
                                         : "assumed: sea water of unknown temperature and salinity");
  options.index = of_water.value_or(options.index);
  state("refractive_index", Text(options.index),
        !of_water.has_value() ? "assumed: sea water at 532 nm"
        : by_state            ? "temperature and salinity of [water], 532 nm"
                              : "the user",
        !of_water.has_value());
  const std::optional<config::Triple>& arm = survey.sensor.lever_arm;
  options.lever_arm = arm.value_or(config::Triple{});
  state("lever_arm_vector", absl::StrCat(Text(options.lever_arm), " m"),
        arm.has_value() ? "the user" : "assumed: none", !arm.has_value());
  const std::optional<double>& datum = survey.datum.sigma;
  options.datum = datum.value_or(0);
  state("datum", absl::StrCat(options.datum, " m"),
        datum.has_value() ? "[datum]" : "assumed: none, ellipsoidal heights", !datum.has_value());
  absl::StatusOr<WaterPlan> planned = PlanWater(water, options.index, plan.numbers);
  if (!planned.ok()) return planned.status();
  plan.water = *std::move(planned);
  return plan;
}

float WaveHeightOfWind(double wind_speed, std::optional<float> fetch, const std::string& spectrum) {
  if (wind_speed <= 0) return 0;
  const bool apel = absl::StartsWith(spectrum, "Apel");
  const WindSea sea{.wind_speed_10m = wind_speed,
                    .fetch = fetch.has_value() ? *fetch : std::numeric_limits<double>::infinity(),
                    .model = apel ? &kApelModel : &kElfouhailyModel};
  return static_cast<float>(std::sqrt(ElevationVariance(Sampled(*sea.MakeSpectrum(), SeaWavenumbers(), 1))));
}

}  // namespace albtpu::client
