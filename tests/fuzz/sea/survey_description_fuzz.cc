// Arbitrary text as a survey file is rejected with one line that names a line of it, or what it says is in range and
// does not contradict itself.
#include <cmath>
#include <string_view>

#include "config/survey_settings.h"
#include "tests/fuzz/fuzz_target.h"

namespace {

using namespace albtpu;
using namespace albtpu::config;

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

void CheckSigmasAreInRange(const config::StatedErrors& sigma) {
  for (std::size_t i = 0; i < albtpu::kErrorSourceCount; ++i) {
    const albtpu::ErrorSource& source = albtpu::kErrorSources[i];
    if (!sigma.stated[i]) continue;
    for (const double number : source.In(sigma.values)) {
      ALBTPU_MUST(number >= 0 && number <= source.greatest);
      ALBTPU_MUST(source.unit != "degree" || number == 0 || number >= config::kLeastAngle);
    }
  }
}

void CheckSurvey(const SurveySettings& survey) {
  ForEachSection([&](const char*, const auto& keys, const auto& section) {
    for (const auto& key : keys) CheckKey(key, section(survey));
  });
  CheckWaves(survey.sea);
  CheckSigmasAreInRange(survey.sigma);
  const TrajectorySettings& trajectory = survey.trajectory;
  ALBTPU_MUST(!trajectory.from_returns.value_or(false) || (trajectory.files.empty() && trajectory.errors.empty()));
  ALBTPU_MUST(!survey.surface.level.has_value() || survey.surface.located.value_or("level") == "level");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data),
                         size);  // A copy: sanitizers see reads beyond it.
  const absl::StatusOr<SurveySettings> survey = ParseSurvey(text, "folder");
  if (!survey.ok()) {
    const std::string_view message(survey.status().message().data(), survey.status().message().size());
    ALBTPU_MUST(absl::IsInvalidArgument(survey.status()));
    ALBTPU_MUST(message.starts_with("line ") || message.starts_with("has "));
    ALBTPU_MUST(message.find('\n') == message.npos && message.find("; ") != message.npos);
  } else {
    CheckSurvey(*survey);
  }
  return 0;
}
