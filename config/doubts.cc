#include "config/doubts.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string_view>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"

namespace albtpu::config {
namespace {

// What a useful survey does not exceed, and the unit that a larger number may be in.
struct Bound {
  std::string_view unit;
  double greatest;
  std::string_view others;
};
constexpr Bound kBounds[] = {{"m", 1, "cm or mm"},
                             {"degree", 0.5, "arc seconds or mrad"},
                             {"s", 0.01, "ms or us"},
                             {"1", 0.02, "units of 1e-6"}};

void Check(std::string_view key, std::string_view unit, std::span<const double> values,
           std::vector<std::string>& doubts) {
  const auto bound = std::ranges::find(kBounds, unit, &Bound::unit);
  if (bound == std::end(kBounds) || std::ranges::max(values) <= bound->greatest) return;
  const std::string of_unit = unit == "1" ? "" : absl::StrCat(" ", std::string(unit));
  doubts.push_back(absl::StrCat(std::string(key), " is ", absl::StrJoin(values, ", "), of_unit, ", more than ",
                                bound->greatest, of_unit, ": is it a standard deviation",
                                unit == "1" ? "" : absl::StrCat(" in", of_unit), ", not in ",
                                std::string(bound->others), "?"));
}

void CheckSources(std::string_view section, const StatedErrors& sigma, std::vector<std::string>& doubts) {
  for (std::size_t i = 0; i < kErrorSourceCount; ++i) {
    const ErrorSource& source = kErrorSources[i];
    if (sigma.stated[i])
      Check(absl::StrCat(std::string(section), " ", std::string(source.name)), source.unit, source.In(sigma.values),
            doubts);
  }
}

}  // namespace

std::vector<std::string> Doubts(const SurveySettings& settings) {
  std::vector<std::string> doubts;
  CheckSources("[sigma]", settings.sigma, doubts);
  for (const ChannelSettings& channel : settings.sensor.channels)
    CheckSources(absl::StrCat("[sensor.channel.sigma] (", channel.label(), ")"), channel.sigma, doubts);
  const auto check = [&](std::string_view key, const std::optional<double>& value) {
    if (value.has_value()) Check(key, "m", std::span(&*value, 1), doubts);
  };
  check("[datum] sigma", settings.datum.sigma);
  check("[datum] mcu", settings.datum.mcu);
  check("[extra] horizontal", settings.extra.horizontal);
  check("[extra] vertical", settings.extra.vertical);
  return doubts;
}

}  // namespace albtpu::config
