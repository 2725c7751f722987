#include "survey/sensors/sigma_range.h"

#include <algorithm>

#include "absl/strings/str_cat.h"

namespace albtpu::client {
namespace {

bool LooksLikeRadians(double value, const SigmaRange& range) {
  return range.unit == "degree" && value > 0 && value < kLeastAngle;
}

void FailAsRadians(TomlKeys& keys, std::string_view key, double value) {
  keys.Fail(key, absl::StrCat("is ", value, " degree (no instrument knows an angle better than ", kLeastAngle,
                              " degree, which looks like radians); give it in degree"));
}

}  // namespace

std::optional<double> ReadSigma(TomlKeys& keys, std::string_view key, const SigmaRange& range) {
  const std::optional<double> value = keys.Number(key, 0, range.greatest, range.unit);
  if (value.has_value() && LooksLikeRadians(*value, range)) FailAsRadians(keys, key, *value);
  return value;
}

std::optional<std::array<double, 3>> ReadSigmas(TomlKeys& keys, std::string_view key,
                                                const SigmaRange& range) {
  const std::optional<std::array<double, 3>> values =
      keys.Triple(key, 0, range.greatest, range.unit, range.parts);
  if (!values.has_value()) return values;
  const auto wrong =
      std::ranges::find_if(*values, [&](double value) { return LooksLikeRadians(value, range); });
  if (wrong != values->end()) FailAsRadians(keys, key, *wrong);
  return values;
}

}  // namespace albtpu::client
