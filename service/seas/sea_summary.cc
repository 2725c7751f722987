#include "service/seas/sea_summary.h"

#include <limits>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "absl/strings/str_split.h"
#include "sea/table/sea_attributes.h"

namespace albtpu {
namespace {

// The value of an attribute that has the type of `absent`, or is a list of one such number; else `absent`.
template <typename Value>
Value Attribute(const UncertaintyTable& table, std::string_view name, Value absent) {
  const auto& attributes = table.provenance().attributes;
  const auto found = attributes.find(std::string(name));
  if (found == attributes.end()) return absent;
  if constexpr (std::is_same_v<Value, double>) {
    const auto* const list = std::get_if<std::vector<double>>(&found->second);
    if (list != nullptr && list->size() == 1) return list->front();
  }
  const auto* const value = std::get_if<Value>(&found->second);
  return value == nullptr ? absent : *value;
}

}  // namespace

std::optional<SeaSummary> SummaryOfSea(const UncertaintyTable& table) {
  if (!table.is_of_one_sea()) return std::nullopt;
  constexpr double kDeep = std::numeric_limits<double>::infinity();
  SeaSummary summary;
  summary.x_azimuth = Attribute(table, sea_attribute::kXAzimuth, 0.0);
  summary.significant_wave_height = Attribute(table, sea_attribute::kSignificantWaveHeight, 0.0);
  summary.wind_speed_10m = Attribute(table, sea_attribute::kWindSpeed, 0.0);
  summary.water_depth = Attribute(table, sea_attribute::kWaterDepth, kDeep);
  summary.tail_from = Attribute(table, sea_attribute::kTailFrom, 0.0);
  summary.share_measured = Attribute(table, sea_attribute::kShareMeasured, 0.0);
  summary.assumptions =
      absl::StrSplit(Attribute(table, sea_attribute::kAssumptions, std::string()), '\n', absl::SkipEmpty());
  return summary;
}

}  // namespace albtpu
