#include "annotate/totals/water_column.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "annotate/run/file_progress.h"
#include "budget/total/reported_point.h"
#include "sea/angle.h"
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

// What was taken of the optics, and whose numbers they are.
void StateOptics(const config::WaterSettings& settings, const WaterOptics& optics, std::vector<StatedNumber>& numbers) {
  const OpticsText text = TextOf(OpticsGiven(settings));
  numbers.push_back({"water_entered", text.entered, "[water]", false});
  numbers.push_back({"water_attenuation", absl::StrFormat("%.4g 1/m", optics.attenuation),
                     absl::StrCat("[water] ", text.way, ": ", text.formula), false});
  numbers.push_back(
      {"water_attenuation_sigma", absl::StrFormat("%.3g %%", 100 * optics.attenuation_log_sigma),
       settings.kd_sigma.has_value() ? "[water] kd_sigma" : absl::StrCat("assumed: what ", text.way, " is good for"),
       !settings.kd_sigma.has_value()});
  const bool albedo_told = settings.omega0.has_value() || settings.absorption.has_value();
  const double ratio = optics.scattering_over_absorption;
  numbers.push_back({"water_albedo", absl::StrFormat("%.3g", ratio / (1 + ratio)),
                     albedo_told ? "[water]" : "assumed: coastal water, 0.8 +- 0.1", !albedo_told});
  numbers.push_back({"water_backscatter_fraction",
                     optics.least_fraction == optics.most_fraction
                         ? absl::StrCat(optics.least_fraction)
                         : absl::StrCat(optics.least_fraction, " to ", optics.most_fraction),
                     settings.backscatter_fraction.has_value() ? "[water]" : "assumed: natural particles",
                     !settings.backscatter_fraction.has_value()});
}

// Whether the treatment leaves the points biased; by BiasHandling.
constexpr std::array<const char*, kBiasHandlingNames.size()> kHandlingTexts = {
    "in the points, and in bias_vertical and bias_along_beam", "its mean was taken away",
    "taken away by the vendor, but for a fraction", "taken away as it was measured, scaled to other depths"};

}  // namespace

std::filesystem::path WaterTablePath() {
  if (const char* path = std::getenv("ALBTPU_WATER_TABLE"); path != nullptr && *path != '\0') return path;
  return InstalledDataDirectory() / "water" / "water_column.h5";
}

std::optional<double> IndexOf(const config::WaterSettings& water) {
  if (water.index.has_value() || !water.temperature.has_value() || !water.salinity.has_value()) return water.index;
  return SeaWaterIndex(*water.temperature, *water.salinity).phase;
}

absl::StatusOr<WaterPlan> PlanWater(const config::WaterSettings& settings, double index,
                                    std::vector<StatedNumber>& numbers) {
  WaterPlan plan{.share = nullptr, .photons = settings.photons, .index = index, .of_water = {}, .surface = {}};
  std::optional<WaterIndex> of_state;
  if (settings.temperature.has_value() && settings.salinity.has_value())
    of_state = SeaWaterIndex(*settings.temperature, *settings.salinity);
  if (settings.processed_with.has_value()) {
    if (!of_state.has_value())
      return formats::UsageError(
          "[water] processed_with needs the index that the water has; give its temperature (degree C) and "
          "salinity");
    plan.of_water = of_state;
    plan.processed_with = *settings.processed_with;
    numbers.push_back({"processed_with", absl::StrCat(*settings.processed_with), "[water]", false});
  }
  if (settings.without_column()) {
    if (settings.bias.has_value())
      return formats::UsageError(
          "[water] bias contradicts column = \"none\" (the share of the water is computed, or left out); "
          "give one of "
          "them");
    numbers.push_back({"water_column", "left out", "[water]", false});
    return plan;
  }
  RETURN_IF_ERROR(CheckReceiver(settings));
  ASSIGN_OR_RETURN(const BiasTreatment treatment, TreatmentOf(settings));
  const absl::StatusOr<WaterOptics> optics = OpticsOf(OpticsGiven(settings));
  if (!optics.ok()) return InWater(optics.status());
  ASSIGN_OR_RETURN(const WaterColumnTable table, ReadWaterTable());
  const WaterReceiver receiver{.detector = static_cast<EchoDetector>(PlaceOf(kEchoDetectorNames, *settings.detector)),
                               .field_of_view = *settings.field_of_view,
                               .pulse_length = *settings.pulse_length,
                               .group_index = of_state.has_value() ? of_state->group : kSeaWaterGroupIndex};
  absl::StatusOr<WaterContribution> share = WaterContribution::Create(table, *optics, receiver, treatment);
  if (!share.ok()) return InWater(share.status());
  if (!settings.processed_with.has_value())
    numbers.push_back(
        {"processed_with", "the group index of the water", "assumed: ranges in water were computed with it", true});
  StateOptics(settings, *optics, numbers);
  numbers.push_back({"water_detector", *settings.detector, "[water]", false});
  numbers.push_back({"water_field_of_view", absl::StrCat(*settings.field_of_view, " m"), "[water]", false});
  numbers.push_back({"water_pulse_length", absl::StrCat(*settings.pulse_length, " ns"), "[water]", false});
  numbers.push_back({"water_bias", *settings.bias,
                     absl::StrCat("[water]: ", kHandlingTexts[static_cast<std::size_t>(treatment.handling)]), false});
  numbers.push_back({"water_table", absl::StrCat(table.table().provenance().id, " ", table.table().digest()),
                     "the installed table", false});
  plan.share = std::make_shared<WaterContribution>(*std::move(share));
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
  const WaterReceiver receiver{.detector = static_cast<EchoDetector>(PlaceOf(kEchoDetectorNames, *water.detector)),
                               .pulse_length = *water.pulse_length};
  if (receiver.detector == EchoDetector::kCentroid) {
    return formats::UsageError(
        "[surface] channel = \"green\" cannot be computed for [water] detector = \"centroid\" (the water's light has "
        "no "
        "end that would give a centroid); give \"half\" or \"peak\", or \"infrared\" where the processing corrected "
        "it");
  }
  plan.surface = GreenSurfaceOf(*optics, receiver);
  const auto metres = [](double length) { return absl::StrFormat("%.3g m", length); };
  const char* const kOrigin = "[water], glint from none to all: docs/physics.md, \"The green surface\"";
  numbers.push_back({"green_surface_range", metres(plan.surface->mean), kOrigin, false});
  numbers.push_back({"green_surface_range_sigma", metres(plan.surface->unknown), kOrigin, false});
  if (options.located != SurfaceLocation::kPulse) return absl::OkStatus();
  numbers.push_back({"green_surface_range_spread", metres(plan.surface->spread), kOrigin, false});
  AirErrors& errors = options.errors;
  double& own = errors.surface_height > 0 ? errors.surface_height : errors.surface_range;
  own = std::hypot(own, plan.surface->spread);
  return absl::OkStatus();
}

namespace {

// A bias that is not known counts as none.
void AddTo(float& bias, double more) { bias = static_cast<float>((std::isfinite(bias) ? bias : 0) + more); }

// That of scattering between surface and bottom.
void AddColumn(const WaterPlan& plan, const PulseBatch& pulses, AnswerBatch& answers, WaterBatch& water) {
  const WaterContribution& share = *plan.share;
  share.Compute(pulses.axis[Index(AxisId::kIncidence)], pulses.axis[Index(AxisId::kDepth)],
                {.bias_along = water.bias_along,
                 .bias_vertical = water.bias_vertical,
                 .sigma_along = water.sigma_along,
                 .sigma_vertical = water.sigma_vertical,
                 .correlation = water.correlation,
                 .stretch = water.stretch});
  for (std::size_t i = 0; i < pulses.size; ++i) {
    if (!answers.interpolated(i)) continue;
    const bool cut = pulses.coordinate(AxisId::kFootprint, i) > share.greatest_footprint();
    if (cut || !std::isfinite(water.sigma_vertical[i])) {
      answers.outcomes[i] = kNoWater;
      water.sigma_vertical[i] = std::numeric_limits<float>::quiet_NaN();
      continue;
    }
    AddTo(answers.values[Index(Quantity::kBiasAlongBeam)][i], water.bias_along[i]);
    AddTo(answers.values[Index(Quantity::kBiasVertical)][i], water.bias_vertical[i]);
    water.noise[i] = 0;
    if (!plan.photons.has_value()) continue;
    const double sine = std::sin(RadiansOfDegrees(pulses.coordinate(AxisId::kIncidence, i))) / plan.index;
    water.noise[i] = static_cast<float>(share.PhotonNoise(*plan.photons, water.stretch[i], std::sqrt(1 - sine * sine)));
  }
}

// The mean is a bias; its uncertainty is common to all pulses, and moves points on one line.
void AddGreenSurface(const GreenSurface& surface, double index, const PulseBatch& pulses, AnswerBatch& answers,
                     WaterBatch& water) {
  for (std::size_t i = 0; i < pulses.size; ++i) {
    if (!answers.interpolated(i)) continue;
    const ShiftBySurface shift = ShiftBySurfaceOf(RadiansOfDegrees(pulses.coordinate(AxisId::kIncidence, i)), index);
    AddTo(answers.values[Index(Quantity::kBiasAlongBeam)][i], shift.along * surface.mean);
    AddTo(answers.values[Index(Quantity::kBiasVertical)][i], -shift.down * surface.mean);
    const double along = water.sigma_along[i], up = water.sigma_vertical[i];
    const double more_along = shift.along * surface.unknown, more_down = shift.down * surface.unknown;
    const double both = water.correlation[i] * along * up - more_along * more_down;
    const double all_along = std::hypot(along, more_along), all_up = std::hypot(up, more_down);
    water.sigma_along[i] = static_cast<float>(all_along);
    water.sigma_vertical[i] = static_cast<float>(all_up);
    water.correlation[i] = all_along > 0 && all_up > 0 ? static_cast<float>(both / (all_along * all_up)) : 0;
  }
}

}  // namespace

void AddWater(const WaterPlan& plan, const PulseBatch& pulses, AnswerBatch& answers, WaterBatch& water) {
  std::vector<float>& along = answers.values[Index(Quantity::kBiasAlongBeam)];
  std::vector<float>& vertical = answers.values[Index(Quantity::kBiasVertical)];
  for (std::size_t i = 0; i < along.size(); ++i)
    along[i] = ReportedBiasAlong(along[i], vertical[i], pulses.coordinate(AxisId::kIncidence, i), plan.index);
  if (plan.of_water.has_value()) {
    for (std::size_t i = 0; i < pulses.size; ++i) {
      const IndexBias bias =
          BiasOfIndex(RadiansOfDegrees(pulses.coordinate(AxisId::kIncidence, i)), *plan.of_water, plan.processed_with);
      const float z = pulses.coordinate(AxisId::kDepth, i);
      AddTo(along[i], bias.along * z);
      AddTo(vertical[i], bias.vertical * z);
    }
  }
  for (std::vector<float>* column : {&water.sigma_along, &water.sigma_vertical, &water.correlation, &water.noise,
                                     &water.bias_along, &water.bias_vertical, &water.stretch})
    column->assign(plan.has_share() ? pulses.size : 0, 0.0f);
  if (pulses.size == 0) return;
  if (plan.share != nullptr) AddColumn(plan, pulses, answers, water);
  if (plan.surface.has_value()) AddGreenSurface(*plan.surface, plan.index, pulses, answers, water);
}

}  // namespace albtpu::annotate
