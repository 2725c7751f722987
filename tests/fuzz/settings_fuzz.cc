// Arbitrary text as a file of settings (a campaign, a sensor, a specification, a survey file) is rejected with one line
// that says what is wrong, or what it says is in range and does not contradict itself.
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/sensors/sensor.h"
#include "config/survey_settings.h"
#include "generator/campaign/campaign.h"
#include "generator/campaign/water_cases.h"
#include "quality/report/specification.h"
#include "tables/format.h"
#include "tests/fuzz/fuzz_target.h"

namespace albtpu::fuzz {
namespace {

using namespace albtpu::config;
using namespace albtpu::quality;

// One line with the problem and the remedy; with `place`, it names a line of the file.
void MustAdvise(const absl::Status& status, bool place) {
  const std::string_view message(status.message().data(), status.message().size());
  ALBTPU_MUST(absl::IsInvalidArgument(status));
  ALBTPU_MUST(!place || message.starts_with("line ") || message.starts_with("has "));
  ALBTPU_MUST(message.find('\n') == message.npos && message.find("; ") != message.npos);
}

void CheckSeaCase(const SeaCase& sea_case) {
  if (const auto* const waves = std::get_if<WindSea>(&sea_case.sea.waves)) {
    ALBTPU_MUST(std::isfinite(waves->wind_speed_10m) && waves->wind_speed_10m >= 0);
    ALBTPU_MUST(waves->fetch > 0);
  }
  ALBTPU_MUST(sea_case.refractive_index > 1 && std::isfinite(sea_case.refractive_index));
  ALBTPU_MUST(!sea_case.depths.empty() && sea_case.depths.front() >= 0);
  for (const BeamOptions& beam : sea_case.beams) {
    ALBTPU_MUST(beam.incidence >= 0 && std::cos(beam.incidence) > 0.49);
    ALBTPU_MUST(beam.footprint > 0 && std::isfinite(beam.footprint));
    ALBTPU_MUST(beam.source_height > 0);
  }
}

void CheckWater(const Campaign& campaign) {
  ALBTPU_MUST(WaterCaseCount(campaign) > 0);
  ALBTPU_MUST(campaign.refractive_index > 1 && campaign.water->group_index > 1);
  ALBTPU_MUST(campaign.water->photons >= 1000 && campaign.water->pairs_per_photon >= 1);
  const auto within = [&](WaterAxis axis, double x) {
    const std::vector<double>& nodes = campaign.axes[Index(axis)].nodes();
    return x >= nodes.front() * (1 - 1e-9) && x <= nodes.back() * (1 + 1e-9);
  };
  const CheckedBeam checked = CheckedBeamOf(campaign, 0);
  ALBTPU_MUST(within(WaterAxis::kBackscatterFraction, checked.backscatter_fraction));
  ALBTPU_MUST(within(WaterAxis::kScatteringOverAbsorption, checked.scattering_over_absorption));
  ALBTPU_MUST(within(WaterAxis::kIncidence, checked.beam.incidence));
  ALBTPU_MUST(within(WaterAxis::kOpticalDepth, checked.beam.optical_depth));
  ALBTPU_MUST(within(WaterAxis::kFieldOfView, checked.beam.field_of_view));
  ALBTPU_MUST(within(WaterAxis::kPulseLength, checked.beam.pulse_length));
}

// All sea cases of a campaign (of the water column: its water cases) can be simulated and its table can be written.
void CampaignTarget(std::string_view text) {
  const absl::StatusOr<Campaign> campaign = ParseCampaign(text);
  if (!campaign.ok()) {
    ALBTPU_MUST(!campaign.status().message().empty());
    ALBTPU_MUST(campaign.status().message().find('\n') == std::string_view::npos);
    return;
  }
  ALBTPU_MUST(campaign->text == text);
  std::size_t count = 1;
  for (const Axis& axis : campaign->axes) {
    ALBTPU_MUST(axis.size() <= format::kMaxNodeCount && axis.size() <= format::kMaxValueCount / count);
    count *= axis.size();
  }
  if (campaign->water) return CheckWater(*campaign);
  ALBTPU_MUST(campaign->effort.realizations >= 2);
  ALBTPU_MUST(campaign->effort.most_realizations >= campaign->effort.realizations);
  CheckSeaCase(SeaCaseOf(*campaign, 0));
  CheckSeaCase(SeaCaseOf(*campaign, SeaCaseCount(*campaign) - 1));
}

// Those that are stated are in range; `or_zero`: some may be perfectly known.
void CheckErrors(const StatedErrors& errors, bool or_zero) {
  for (std::size_t i = 0; i < kErrorSourceCount; ++i) {
    const ErrorSource& source = kErrorSources[i];
    if (!errors.stated[i]) continue;
    for (const double number : source.In(errors.values)) {
      if (or_zero && number == 0) continue;
      ALBTPU_MUST(number > 0 && number <= source.greatest);
      ALBTPU_MUST(source.unit != "degree" || number >= kLeastAngle);
    }
  }
}

// Each number of a sensor has a source.
void SensorTarget(std::string_view text) {
  const absl::StatusOr<Sensor> sensor = ParseSensor(text);
  if (!sensor.ok()) return MustAdvise(sensor.status(), true);
  ALBTPU_MUST(!sensor->title.empty());
  for (std::size_t i = 0; i < kErrorSourceCount; ++i) {
    ALBTPU_MUST(kErrorSources[i].of_sensor || !sensor->errors.stated[i]);
    ALBTPU_MUST(sensor->errors.stated[i] != sensor->origins[i].empty());
  }
  CheckErrors(sensor->errors, false);
  if (!sensor->divergence.has_value()) return;
  const SourcedDivergence& divergence = *sensor->divergence;
  ALBTPU_MUST(divergence.least.value_or(kLeastDivergence) <= divergence.value);
  ALBTPU_MUST(divergence.value <= divergence.greatest.value_or(kGreatestDivergence));
  ALBTPU_MUST(!divergence.source.empty());
}

// The classes have names of their own and limits that grow with the depth.
void SpecificationTarget(std::string_view text) {
  const absl::StatusOr<Specification> specification = ParseSpecification(text);
  if (!specification.ok()) return MustAdvise(specification.status(), false);
  ALBTPU_MUST(!specification->title.empty() && !specification->source.empty());
  ALBTPU_MUST(!specification->classes.empty());
  std::set<std::string> names;
  for (const SpecificationClass& of : specification->classes) {
    ALBTPU_MUST(names.insert(of.name).second);
    ALBTPU_MUST(of.horizontal.has_value() || of.vertical.has_value());
    for (const auto& limit : {of.horizontal, of.vertical}) {
      if (!limit.has_value()) continue;
      ALBTPU_MUST(limit->constant >= 0 && limit->constant <= 1000);
      ALBTPU_MUST(limit->of_depth >= 0 && limit->of_depth <= 1);
      ALBTPU_MUST(limit->At(0) == limit->constant && limit->At(30) >= limit->constant);
    }
  }
}

template <typename Settings>
void CheckKey(const Key<Settings>& key, const Settings& settings) {
  if (const auto* number = std::get_if<Number>(&key.declaration.values)) {
    const auto& value = settings.*std::get<std::optional<double> Settings::*>(key.member);
    ALBTPU_MUST(!value.has_value() || (*value >= number->least && *value <= number->greatest));
  } else if (const auto* text = std::get_if<std::optional<std::string> Settings::*>(&key.member)) {
    ALBTPU_MUST(!(settings.**text).has_value() || !(settings.**text)->empty());
  } else if (const auto* classes = std::get_if<std::vector<int> Settings::*>(&key.member)) {
    for (const int each : settings.**classes) ALBTPU_MUST(each >= kClasses.least && each <= kClasses.greatest);
  }
}

void CheckWaves(const SeaSettings& sea) {
  for (const JonswapWaves& waves : sea.waves) {
    ALBTPU_MUST(waves.significant_wave_height >= 0 && waves.significant_wave_height <= 30);
    ALBTPU_MUST(waves.peak_period >= 0.5 && waves.peak_period <= 40 && waves.gamma >= 1 && waves.gamma <= 20);
    ALBTPU_MUST(std::isfinite(waves.travels_towards) && waves.spread.value_or(0) >= 0);
  }
  const absl::Status status = CheckSea(sea);
  ALBTPU_MUST(status.ok() || absl::IsInvalidArgument(status));
}

void SurveyTarget(std::string_view text) {
  const absl::StatusOr<SurveySettings> survey = ParseSurvey(text, "folder");
  if (!survey.ok()) return MustAdvise(survey.status(), true);
  ForEachSection([&](const char*, const auto& keys, const auto& section) {
    for (const auto& key : keys) CheckKey(key, section(*survey));
  });
  CheckWaves(survey->sea);
  CheckErrors(survey->sigma, true);
  const TrajectorySettings& trajectory = survey->trajectory;
  ALBTPU_MUST(!trajectory.from_returns.value_or(false) || (trajectory.files.empty() && trajectory.errors.empty()));
  ALBTPU_MUST(!survey->surface.level.has_value() || survey->surface.located.value_or("level") == "level");
}

}  // namespace

const std::vector<Target> kTargets = {{"campaign", CampaignTarget},
                                      {"sensor_file", SensorTarget},
                                      {"specification", SpecificationTarget},
                                      {"survey_description", SurveyTarget}};

}  // namespace albtpu::fuzz
