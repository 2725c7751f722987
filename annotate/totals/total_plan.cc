#include "annotate/totals/total_plan.h"

#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"

namespace albtpu::annotate {

StatedNumber AssumedDivergence(double milliradians) {
  return {"divergence", absl::StrCat(milliradians, " mrad"), "assumed: the default of the sensor", true};
}

nlohmann::ordered_json Parameters(const TotalPlan& plan) {
  nlohmann::ordered_json json;
  json["located"] = std::string(kSurfaceLocationNames[static_cast<std::size_t>(plan.options.located)]);
  for (const StatedNumber& number : plan.numbers)
    json["numbers"][number.name] = {
        {"value", number.value}, {"source", number.source}, {"assumed", number.assumed}};
  return json;
}

std::vector<std::string> Assumptions(const TotalPlan& plan) {
  std::vector<std::string> lines;
  for (const StatedNumber& number : plan.numbers) {
    if (number.assumed)
      lines.push_back(absl::StrCat(number.name, " ", number.value, " (", number.source, ")"));
  }
  return lines;
}

}  // namespace albtpu::annotate
