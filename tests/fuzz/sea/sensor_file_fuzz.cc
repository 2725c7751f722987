// Arbitrary text as a file of a sensor is rejected with one line that names a line of it, or each of its numbers is
// above 0, in range, and has a source.
#include <string_view>

#include "config/sensors/sensor.h"
#include "tests/fuzz/fuzz_target.h"

namespace {

using namespace albtpu::config;

void CheckSensor(const Sensor& sensor) {
  ALBTPU_MUST(!sensor.title.empty());
  for (std::size_t i = 0; i < albtpu::kErrorSourceCount; ++i) {
    const albtpu::ErrorSource& source = albtpu::kErrorSources[i];
    ALBTPU_MUST(source.of_sensor || !sensor.errors.stated[i]);
    ALBTPU_MUST(sensor.errors.stated[i] != sensor.origins[i].empty());
    if (!sensor.errors.stated[i]) continue;
    for (const double number : source.In(sensor.errors.values)) {
      ALBTPU_MUST(number > 0 && number <= source.greatest);
      ALBTPU_MUST(source.unit != "degree" || number >= kLeastAngle);
    }
  }
  if (!sensor.divergence.has_value()) return;
  const SourcedDivergence& divergence = *sensor.divergence;
  ALBTPU_MUST(divergence.least.value_or(kLeastDivergence) <= divergence.value);
  ALBTPU_MUST(divergence.value <= divergence.greatest.value_or(kGreatestDivergence));
  ALBTPU_MUST(!divergence.source.empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data),
                         size);  // A copy: sanitizers see reads beyond it.
  const absl::StatusOr<Sensor> sensor = ParseSensor(text);
  if (!sensor.ok()) {
    const std::string_view message(sensor.status().message().data(), sensor.status().message().size());
    ALBTPU_MUST(absl::IsInvalidArgument(sensor.status()));
    ALBTPU_MUST(message.starts_with("line ") || message.starts_with("has "));
    ALBTPU_MUST(message.find('\n') == message.npos && message.find("; ") != message.npos);
  } else {
    CheckSensor(*sensor);
  }
  return 0;
}
