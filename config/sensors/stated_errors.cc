#include "config/sensors/stated_errors.h"

#include <algorithm>
#include <optional>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"

namespace albtpu::config {

std::string PartsText(const ErrorSource& source) {
  const auto append = [](std::string* to, std::string_view part) { to->append(part); };
  return absl::StrCat("[", absl::StrJoin(source.parts, ", ", append), "]");
}

void ReadErrors(config::TomlKeys& keys, std::string_view key, std::size_t i, StatedErrors& errors) {
  const ErrorSource& source = kErrorSources[i];
  const std::span<double> numbers = source.In(errors.values);
  if (numbers.size() == 1) {
    const std::optional<double> number = keys.Number(key, 0, source.greatest, source.unit);
    errors.stated[i] = number.has_value();
    numbers[0] = number.value_or(0);
  } else {
    const std::optional<std::array<double, 3>> triple =
        keys.Triple(key, 0, source.greatest, source.unit, PartsText(source));
    errors.stated[i] = triple.has_value();
    if (triple.has_value()) std::ranges::copy(*triple, numbers.begin());
  }
  if (!errors.stated[i] || source.unit != "degree") return;
  const auto radians =
      std::ranges::find_if(numbers, [](double number) { return number > 0 && number < kLeastAngle; });
  if (radians == numbers.end()) return;
  keys.Fail(key, absl::StrCat("is ", *radians, " degree (no instrument knows an angle better than ",
                              kLeastAngle, " degree, which looks like radians); give it in degree"));
}

}  // namespace albtpu::config
