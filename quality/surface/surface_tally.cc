#include "quality/surface/surface_tally.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "quality/surface/surface_file.h"
#include "tables/coverage.h"

namespace albtpu::quality {

namespace {

using Json = nlohmann::ordered_json;

}  // namespace

void SurfaceTally::Add(const SurfaceNode& node) {
  if (node.points == 0) {
    left_out += node.left_out;
    return;
  }
  lowest = std::min(lowest, node.elevation), highest = std::max(highest, node.elevation);
  ++nodes, points += node.points, left_out += node.left_out;
  if (node.points > node.dry) ++orders[OrderOf(node) - 1U];
  dry += node.dry, of_land += node.points == node.dry, of_both += node.dry > 0 && node.points > node.dry;
  const NodeVariance& v = node.variance;
  pulse += v.pulse, sea += v.sea, line += v.line, survey += v.survey;
  const double factor = VerticalFactor(Coverage::kP95);
  uncertainty += factor * std::sqrt(v.total());
  mean_of_points += factor * std::sqrt(v.of_point + v.survey);
  independent += factor * std::sqrt((v.of_point + v.survey) / node.points);
  if (node.points > 1 && v.within_cell(node.points) > 0) {
    squares += (node.points - 1.0) * node.deviation * node.deviation;
    predicted += (node.points - 1.0) * v.within_cell(node.points);
    chi_square += (node.points - 1.0) * node.deviation * node.deviation / v.within_cell(node.points);
    degrees += node.points - 1.0;
  }
}

Json SurfaceTally::ToJson() const {
  const auto n = static_cast<double>(std::max<std::uint64_t>(nodes, 1));
  const double variance = pulse + sea + line + survey;
  const auto share = [variance](double part) { return variance > 0 ? part / variance : 0; };
  Json json = {
      {"nodes", nodes},
      {"points", points},
      {"left_out", left_out},
      {"lowest", lowest},
      {"highest", highest},
      {"uncertainty_95", uncertainty / n},
      {"shares", {{"pulse", share(pulse)}, {"sea", share(sea)}, {"line", share(line)}, {"survey", share(survey)}}},
      {"for_comparison",
       {{"points_taken_as_independent_95", independent / n}, {"mean_tvu_of_points_95", mean_of_points / n}}},
      {"order_met", Json::object()},
      {"deviation", {{"degrees_of_freedom", degrees}}}};
  for (std::size_t i = 0; i < orders.size(); ++i)
    json["order_met"][i < kS44Orders.size() ? std::string(kS44OrderNames[i]) : "none"] = orders[i];
  json["deviation"]["sample"] = degrees > 0 ? Json(std::sqrt(squares / degrees)) : Json();
  json["deviation"]["predicted"] = degrees > 0 ? Json(std::sqrt(predicted / degrees)) : Json();
  json["deviation"]["factor"] = degrees > 0 ? Json(std::sqrt(chi_square / degrees)) : Json();
  return json;
}

}  // namespace albtpu::quality
