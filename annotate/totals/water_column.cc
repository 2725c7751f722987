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

// Of sea water at 15 degrees and a salinity of 35.
constexpr double kUsualGroupIndex = 1.3643;

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
  const std::string way = settings.kd.has_value()       ? absl::StrCat("kd of kind ", *settings.kd_kind)
                          : settings.secchi.has_value() ? "the Secchi depth"
                          : settings.jerlov.has_value() ? absl::StrCat("Jerlov type ", *settings.jerlov)
                                                        : "absorption and scattering";
  numbers.push_back(
      {"water_attenuation", absl::StrFormat("%.4g 1/m", optics.attenuation), absl::StrCat("[water] ", way), false});
  numbers.push_back(
      {"water_attenuation_sigma", absl::StrFormat("%.3g %%", 100 * optics.attenuation_log_sigma),
       settings.kd_sigma.has_value() ? "[water] kd_sigma" : absl::StrCat("assumed: what ", way, " is good for"),
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
  WaterPlan plan{.share = nullptr, .photons = settings.photons, .index = index, .of_water = {}};
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
                               .group_index = of_state.has_value() ? of_state->group : kUsualGroupIndex};
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
                     WaterTablePath().string(), false});
  plan.share = std::make_shared<WaterContribution>(*std::move(share));
  return plan;
}

void AddWater(const WaterPlan& plan, const PulseBatch& pulses, AnswerBatch& answers, WaterBatch& water) {
  const std::span<const float> incidence = pulses.axis[Index(AxisId::kIncidence)];
  const std::span<const float> depth = pulses.axis[Index(AxisId::kDepth)];
  const auto add = [](float& bias, double more) { bias = static_cast<float>((std::isfinite(bias) ? bias : 0) + more); };
  std::vector<float>& along = answers.values[Index(Quantity::kBiasAlongBeam)];
  std::vector<float>& vertical = answers.values[Index(Quantity::kBiasVertical)];
  for (std::size_t i = 0; i < along.size(); ++i)
    along[i] = ReportedBiasAlong(along[i], vertical[i], pulses.coordinate(AxisId::kIncidence, i), plan.index);
  if (plan.of_water.has_value()) {
    for (std::size_t i = 0; i < pulses.size; ++i) {
      const IndexBias bias =
          BiasOfIndex(RadiansOfDegrees(pulses.coordinate(AxisId::kIncidence, i)), *plan.of_water, plan.processed_with);
      const float z = pulses.coordinate(AxisId::kDepth, i);
      add(along[i], bias.along * z);
      add(vertical[i], bias.vertical * z);
    }
  }
  for (std::vector<float>* column : {&water.sigma_along, &water.sigma_vertical, &water.correlation, &water.noise,
                                     &water.bias_along, &water.bias_vertical, &water.stretch})
    column->resize(plan.share != nullptr ? pulses.size : 0);
  if (plan.share == nullptr || pulses.size == 0) return;
  const WaterContribution& share = *plan.share;
  share.Compute(incidence, depth,
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
    add(along[i], water.bias_along[i]);
    add(vertical[i], water.bias_vertical[i]);
    water.noise[i] = 0;
    if (!plan.photons.has_value()) continue;
    const double sine = std::sin(RadiansOfDegrees(pulses.coordinate(AxisId::kIncidence, i))) / plan.index;
    water.noise[i] = static_cast<float>(share.PhotonNoise(*plan.photons, water.stretch[i], std::sqrt(1 - sine * sine)));
  }
}

}  // namespace albtpu::annotate
