// Arbitrary text as a survey file is rejected with one line that names a line of it, or what it says of the sea is in
// range.
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
  } else if (survey->sea.has_value()) {
    CheckSeaIsInRange(*survey->sea);
  }
  return 0;
}
