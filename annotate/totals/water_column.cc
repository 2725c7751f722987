#include "annotate/totals/water_column.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "annotate/run/file_progress.h"
#include "budget/total/reported_point.h"
#include "status/status_macros.h"
#include "tables/default_tables.h"
#include "tables/file/table_io.h"

namespace albtpu::annotate {
namespace {

template <typename Names>
std::size_t PlaceOf(const Names& names, const std::string& name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

absl::Status InWater(const absl::Status& status) {
  return formats::UsageError(absl::StrCat("[water] ", std::string(status.message())));
}

OpticsInput OpticsGiven(const config::WaterSettings& settings) {
  OpticsInput optics{.kd = settings.kd,
                     .kd_kind = {},
                     .secchi = settings.secchi,
                     .jerlov = {},
                     .absorption = settings.absorption,
                     .scattering = settings.scattering,
                     .kd_sigma = settings.kd_sigma,
                     .omega0 = settings.omega0,
                     .omega0_sigma = settings.omega0_sigma,
                     .backscatter_fraction = settings.backscatter_fraction};
  if (settings.kd_kind.has_value()) optics.kd_kind = static_cast<KdKind>(PlaceOf(kKdKindNames, *settings.kd_kind));
  if (settings.jerlov.has_value()) optics.jerlov = *settings.jerlov;
  return optics;
}

absl::StatusOr<BiasTreatment> TreatmentOf(const config::WaterSettings& settings) {
  BiasTreatment treatment{.handling = static_cast<BiasHandling>(PlaceOf(kBiasHandlingNames, *settings.bias))};
  const auto needs = [&](BiasHandling handling, bool has, const char* key, const char* what) -> absl::Status {
    if ((treatment.handling == handling) == has) return absl::OkStatus();
    if (has)
      return formats::UsageError(absl::StrCat(
          "[water] ", key, " has no effect with bias = \"", *settings.bias, "\"; leave it out, or give bias = \"",
          std::string(kBiasHandlingNames[static_cast<std::size_t>(handling)]), "\""));
    return formats::UsageError(absl::StrCat("[water] bias = \"", *settings.bias, "\" needs ", key, "; give ", what));
  };
  RETURN_IF_ERROR(needs(BiasHandling::kVendor, settings.residual_fraction.has_value(), "residual_fraction",
                        "the fraction of the bias that remains, 0 to 1"));
  const char* const kCalibration = "calibration = {depth = 5, offset = -0.04, sigma = 0.01}, in m";
  if (absl::Status status =
          needs(BiasHandling::kCalibrated, settings.calibration.has_value(), "calibration", kCalibration);
      !status.ok())
    return status;
  treatment.residual_fraction = settings.residual_fraction.value_or(0);
  if (!settings.calibration.has_value()) return treatment;
  const config::CalibrationSettings& calibration = *settings.calibration;
  if (!calibration.depth.has_value() || !calibration.offset.has_value() || !calibration.sigma.has_value())
    return formats::UsageError(absl::StrCat("[water] calibration lacks a number; give ", kCalibration));
  treatment.calibration_depth = *calibration.depth;
  treatment.calibration_offset = *calibration.offset;
  treatment.calibration_sigma = *calibration.sigma;
  return treatment;
}

absl::Status CheckReceiver(const config::WaterSettings& settings) {
  std::string missing;
  const auto need = [&](bool has, const char* what) {
    if (!has) absl::StrAppend(&missing, missing.empty() ? "" : ", ", what);
  };
  need(settings.detector.has_value(), "detector");
  need(settings.field_of_view.has_value(), "field_of_view (m)");
  need(settings.pulse_length.has_value(), "pulse_length (ns)");
  if (missing.empty()) return absl::OkStatus();
  return formats::UsageError(absl::StrCat(
      "[water] lacks ", missing, " (the bias of the water column depends on it); give it, or column = \"none\""));
}

absl::StatusOr<WaterColumnTable> ReadWaterTable() {
  absl::StatusOr<Table> table = ReadTable(WaterTablePath(), kWaterColumn);
  if (!table.ok()) {
    return absl::Status(table.status().code(),
                        absl::StrCat(std::string(table.status().message()),
                                     "; name a table of the water column by ALBTPU_WATER_TABLE"));
  }
  return WaterColumnTable::Create(*std::move(table));
}

std::string BeyondTable(double share) {
  return share > 0 ? absl::StrFormat("; %.2g %% of such waters scatter more than any of the table, and are left out",
                                     100 * share)
                   : "";
}

// What was taken of the optics, and whose numbers they are.
void StateOptics(const config::WaterSettings& settings, const CompiledWater& water,
                 std::vector<StatedNumber>& numbers) {
  const WaterOptics& optics = *water.optics;
  const OpticsText text = TextOf(OpticsGiven(settings));
  numbers.push_back({"water_entered", text.entered, "[water]", false});
  numbers.push_back({"water_attenuation", absl::StrFormat("%.4g 1/m", optics.attenuation),
                     absl::StrCat("[water] ", text.way, ": ", text.formula), false});
  numbers.push_back(
      {"water_attenuation_sigma", absl::StrFormat("%.3g %%", 100 * optics.attenuation_log_sigma),
       settings.kd_sigma.has_value() ? "[water] kd_sigma" : absl::StrCat("assumed: what ", text.way, " is good for"),
       !settings.kd_sigma.has_value()});
  const bool albedo_told = settings.omega0.has_value() || settings.absorption.has_value();
  const char* const assumed = optics.limited_by_pure_water()
                                  ? "assumed: as coastal water, 0.8 +- 0.1, but absorbs as pure water"
                                  : "assumed: coastal water, 0.8 +- 0.1";
  numbers.push_back({"water_albedo", absl::StrFormat("%.3g", optics.typical_albedo()),
                     albedo_told ? absl::StrCat("[water]", BeyondTable(water.beyond_table())) : assumed, !albedo_told});
  numbers.push_back({"water_backscatter_fraction",
                     optics.least_fraction == optics.most_fraction
                         ? absl::StrCat(optics.least_fraction)
                         : absl::StrCat(optics.least_fraction, " to ", optics.most_fraction),
                     settings.backscatter_fraction.has_value() ? "[water]" : "assumed: natural particles",
                     !settings.backscatter_fraction.has_value()});
}

EchoDetector DetectorOf(const config::WaterSettings& settings) {
  return static_cast<EchoDetector>(PlaceOf(kEchoDetectorNames, *settings.detector));
}

absl::StatusOr<WaterPlan> Compile(const WaterColumnTable* table, const KnownWater& known, double index) {
  absl::StatusOr<CompiledWater> compiled = CompileWater(table, known);
  if (!compiled.ok()) return InWater(compiled.status());
  WaterPlan plan;
  static_cast<CompiledWater&>(plan) = *std::move(compiled);
  plan.index = index;
  return plan;
}

// Whether the treatment leaves the points biased; by BiasHandling.
constexpr std::array<const char*, kBiasHandlingNames.size()> kHandlingTexts = {
    "in the points, and in bias_vertical and bias_along_beam", "its mean was taken away",
    "taken away by the vendor, but for a fraction", "taken away as it was measured, scaled to other depths"};

}  // namespace

std::optional<double> IndexOf(const config::WaterSettings& water) {
  if (water.index.has_value() || !water.temperature.has_value() || !water.salinity.has_value()) return water.index;
  return SeaWaterIndex(*water.temperature, *water.salinity).phase;
}

absl::StatusOr<WaterPlan> PlanWater(const config::WaterSettings& settings, double index,
                                    std::vector<StatedNumber>& numbers) {
  KnownWater known{.optics = OpticsGiven(settings),
                   .photons = settings.photons,
                   .temperature = settings.temperature,
                   .salinity = settings.salinity,
                   .processed_with = settings.processed_with};
  if (settings.processed_with.has_value())
    numbers.push_back({"processed_with", absl::StrCat(*settings.processed_with), "[water]", false});
  if (settings.without_column()) {
    const char* const given = settings.bias.has_value()                ? "bias"
                              : settings.residual_fraction.has_value() ? "residual_fraction"
                              : settings.calibration.has_value()       ? "calibration"
                              : settings.photons.has_value()           ? "photons"
                                                                       : nullptr;
    if (given != nullptr) {
      return formats::UsageError(absl::StrCat("[water] ", given,
                                              " contradicts column = \"none\" (the share of the water is computed, or "
                                              "left out); give one of them"));
    }
    numbers.push_back({"water_column", "left out", "[water]", false});
    return Compile(nullptr, known, index);
  }
  RETURN_IF_ERROR(CheckReceiver(settings));
  ASSIGN_OR_RETURN(const BiasTreatment treatment, TreatmentOf(settings));
  if (const absl::StatusOr<WaterOptics> optics = OpticsOf(OpticsGiven(settings)); !optics.ok())
    return InWater(optics.status());
  ASSIGN_OR_RETURN(const WaterColumnTable table, ReadWaterTable());
  known.detector = DetectorOf(settings);
  known.field_of_view = *settings.field_of_view;
  known.pulse_length = *settings.pulse_length;
  known.bias = treatment;
  ASSIGN_OR_RETURN(WaterPlan plan, Compile(&table, known, index));
  if (!settings.processed_with.has_value())
    numbers.push_back(
        {"processed_with", "the group index of the water", "assumed: ranges in water were computed with it", true});
  StateOptics(settings, plan, numbers);
  numbers.push_back({"water_detector", *settings.detector, "[water]", false});
  numbers.push_back({"water_field_of_view", absl::StrCat(*settings.field_of_view, " m"), "[water]", false});
  numbers.push_back({"water_pulse_length", absl::StrCat(*settings.pulse_length, " ns"), "[water]", false});
  numbers.push_back({"water_bias", *settings.bias,
                     absl::StrCat("[water]: ", kHandlingTexts[static_cast<std::size_t>(treatment.handling)]), false});
  numbers.push_back({"water_table", absl::StrCat(table.table().provenance().id, " ", table.table().digest()),
                     "the installed table", false});
  return plan;
}

absl::Status PlanGreenSurface(const config::SurveySettings& survey, BudgetOptions& options, WaterPlan& plan,
                              std::vector<StatedNumber>& numbers) {
  const bool by_returns = options.located != SurfaceLocation::kLevel;
  if (!survey.surface.channel.has_value()) {
    plan.channel_assumed = by_returns;
    return absl::OkStatus();
  }
  const std::string& channel = *survey.surface.channel;
  if (!by_returns) {
    return formats::UsageError(absl::StrCat("[surface] channel = \"", channel,
                                            "\" has no effect where a level locates the surface; leave it out"));
  }
  numbers.push_back({"surface_channel", channel, "[surface]", false});
  if (channel != "green") return absl::OkStatus();
  const config::WaterSettings& water = survey.water;
  const absl::StatusOr<WaterOptics> optics = OpticsOf(OpticsGiven(water));
  if (!optics.ok() || !water.detector.has_value() || !water.pulse_length.has_value()) {
    return formats::UsageError(absl::StrCat(
        "[surface] channel = \"green\" (the surface is found too low, by the light that the water scatters back) needs "
        "[water] ",
        optics.ok() ? "detector and pulse_length (ns)"
                    : absl::StrCat("optics, detector and pulse_length: ", std::string(optics.status().message()))));
  }
  const KnownWater known{.optics = OpticsGiven(water),
                         .detector = DetectorOf(water),
                         .pulse_length = *water.pulse_length,
                         .green_surface = true};
  if (known.detector == EchoDetector::kCentroid) {
    return formats::UsageError(
        "[surface] channel = \"green\" cannot be computed for [water] detector = \"centroid\" (the water's light has "
        "no "
        "end that would give a centroid); give \"half\" or \"peak\", or \"infrared\" where the processing corrected "
        "it");
  }
  ASSIGN_OR_RETURN(const CompiledWater compiled, CompileWater(nullptr, known));
  plan.surface = compiled.surface;
  const auto metres = [](double length) { return absl::StrFormat("%.3g m", length); };
  const char* const kOrigin = "[water], glint from none to all: docs/physics.md, \"The green surface\"";
  numbers.push_back({"green_surface_range", metres(plan.surface->mean), kOrigin, false});
  numbers.push_back({"green_surface_range_sigma", metres(plan.surface->unknown), kOrigin, false});
  if (options.located != SurfaceLocation::kPulse) return absl::OkStatus();
  numbers.push_back({"green_surface_range_spread", metres(plan.surface->spread), kOrigin, false});
  AddGreenSpread(*plan.surface, options.located, options.errors);
  return absl::OkStatus();
}

void AddWater(const WaterPlan& plan, const PulseBatch& pulses, AnswerBatch& answers, WaterBatch& water) {
  std::vector<float>& along = answers.values[Index(Quantity::kBiasAlongBeam)];
  std::vector<float>& vertical = answers.values[Index(Quantity::kBiasVertical)];
  for (std::size_t i = 0; i < along.size(); ++i)
    along[i] = ReportedBiasAlong(along[i], vertical[i], pulses.coordinate(AxisId::kIncidence, i), plan.index);
  ComputeWater(plan, plan.index,
               {.size = pulses.size,
                .incidence = pulses.axis[Index(AxisId::kIncidence)],
                .depth = pulses.axis[Index(AxisId::kDepth)],
                .footprint = pulses.axis[Index(AxisId::kFootprint)]},
               water);
  if (water.bias_along.empty()) return;
  for (std::size_t i = 0; i < pulses.size; ++i) {
    if (!answers.interpolated(i)) continue;
    along[i] = BiasInWater(along[i], water.bias_along[i]);
    vertical[i] = BiasInWater(vertical[i], water.bias_vertical[i]);
    if (!water.is_beyond(i)) continue;
    answers.outcomes[i] = kNoWater;
    along[i] = vertical[i] = NAN;  // Those of the sea alone are not the point's.
  }
}

}  // namespace albtpu::annotate
