#include "quality/report/line_tallies.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace albtpu::quality {

void LineTallies::Add(const AnnotatedPoint& point, const FlightLines& lines, std::uint64_t met, Coverage coverage) {
  const std::optional<std::uint16_t> number = lines.NumberOf(point.line, point.time);
  OfLine& line = lines_[{point.line, number.has_value() ? *number : kUnknown}];
  line.tally.Add(point, met, coverage);
  line.path.Add(point);
}

nlohmann::ordered_json LineTallies::Json(const FlightLines& lines, std::size_t classes) const {
  auto list = nlohmann::ordered_json::array();
  for (const auto& [key, line] : lines_) {
    const auto [id, number] = key;
    nlohmann::ordered_json json = {{"line", id}};
    const FlightLine flight = number == kUnknown ? FlightLine{} : lines.Line(static_cast<std::uint16_t>(number));
    if (std::isfinite(flight.begin)) json["begin"] = flight.begin;
    json.update(line.tally.Json(classes));
    json["path"] = line.path.Json();
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace albtpu::quality
