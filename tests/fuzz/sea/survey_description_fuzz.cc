// Arbitrary text as a survey file is rejected with one line that names a line of it, or what it says is in range and
// does not contradict itself.
#include <cmath>
#include <string_view>

#include "survey/description/survey_description.h"
#include "tests/fuzz/fuzz_target.h"

namespace {

using namespace albtpu;
using namespace albtpu::client;

void CheckSeaIsInRange(const ToldSea& sea) {
  for (const auto& number : kSeaNumbers) {
    const std::optional<double>& value = sea.*number.field;
    ALBTPU_MUST(!value.has_value() || (*value >= number.least && *value <= number.greatest));
  }
  for (const auto& text : kSeaTexts) {
    const std::optional<std::string>& value = sea.*text.field;
    ALBTPU_MUST(!value.has_value() || !value->empty());
  }
  for (const JonswapWaves& waves : sea.waves) {
    ALBTPU_MUST(waves.significant_wave_height >= 0 && waves.significant_wave_height <= 30);
    ALBTPU_MUST(waves.peak_period >= 0.5 && waves.peak_period <= 40 && waves.gamma >= 1 && waves.gamma <= 20);
    ALBTPU_MUST(std::isfinite(waves.travels_towards) && waves.spread.value_or(0) >= 0);
  }
  const absl::Status status = CheckSea(sea);
  ALBTPU_MUST(status.ok() || absl::IsInvalidArgument(status));
}

template <typename Keys, typename Told>
void CheckNumbersAreInRange(const Keys& keys, const Told& told) {
  for (const auto& each : keys) {
    const std::optional<double>& value = told.*each.field;
    ALBTPU_MUST(!value.has_value() || (*value >= each.least && *value <= each.greatest));
  }
}

void CheckSigmasAreInRange(const StatedErrors& sigma) {
  for (std::size_t i = 0; i < albtpu::kErrorSourceCount; ++i) {
    const albtpu::ErrorSource& source = albtpu::kErrorSources[i];
    if (!sigma.stated[i]) continue;
    for (const double number : source.In(sigma.values)) {
      ALBTPU_MUST(number >= 0 && number <= source.greatest);
      ALBTPU_MUST(source.unit != "degree" || number == 0 || number >= kLeastAngle);
    }
  }
}

void CheckClasses(const std::vector<int>& classes) {
  for (const int each : classes) ALBTPU_MUST(each >= 0 && each <= kGreatestClass);
}

void CheckSurvey(const SurveyDescription& survey) {
  if (survey.sea.has_value()) CheckSeaIsInRange(*survey.sea);
  if (survey.water.has_value()) CheckNumbersAreInRange(kWaterNumbers, *survey.water);
  if (survey.datum.has_value()) CheckNumbersAreInRange(kDatumNumbers, *survey.datum);
  if (survey.sigma.has_value()) CheckSigmasAreInRange(*survey.sigma);
  if (survey.output.has_value()) CheckClasses(survey.output->classes);
  if (const auto& trajectory = survey.trajectory; trajectory.has_value())
    ALBTPU_MUST(!trajectory->from_returns.value_or(false) ||
                (trajectory->files.empty() && trajectory->errors.empty()));
  if (const auto& surface = survey.surface; surface.has_value()) {
    CheckClasses(surface->classes);
    const bool level = surface->level.has_value() || surface->level_file.has_value();
    ALBTPU_MUST(!level || surface->located.value_or("level") == "level");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data),
                         size);  // A copy: sanitizers see reads beyond it.
  const absl::StatusOr<SurveyDescription> survey = ParseSurvey(text, "folder");
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
