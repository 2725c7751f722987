// Arbitrary text as a file of a sensor is rejected with one line that names a line of it, or each of its numbers is
// above 0, in range, and has a source.
#include <string_view>

#include "survey/sensors/sensor.h"
#include "tests/fuzz/fuzz_target.h"

namespace {

using namespace albtpu::client;

void CheckNumber(const SigmaRange& range, double value) {
  ALBTPU_MUST(value > 0 && value <= range.greatest);
  ALBTPU_MUST(range.unit != "degree" || value >= kLeastAngle);
}

void CheckSensor(const Sensor& sensor) {
  ALBTPU_MUST(!sensor.title.empty());
  for (const auto& [range, field] : kSensorNumbers) {
    if (!(sensor.*field).has_value()) continue;
    CheckNumber(range, (sensor.*field)->value);
    ALBTPU_MUST(!(sensor.*field)->source.empty());
  }
  for (const auto& [range, field] : kSensorTriples) {
    if (!(sensor.*field).has_value()) continue;
    for (const double value : (sensor.*field)->value) CheckNumber(range, value);
    ALBTPU_MUST(!(sensor.*field)->source.empty());
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
