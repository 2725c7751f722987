#include "quality/report/land_table.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace albtpu::quality {
namespace {

using nlohmann::ordered_json;

ordered_json SigmaJson(const annotate::LengthSpread& spread) {
  return {{"median", spread.quantile(0.5)}, {"p95", spread.quantile(0.95)}, {"greatest", spread.greatest()}};
}

// Of one component: the errors of the points and of the check points are independent, so that variances add.
struct AgainstCheckPoints {
  AgainstCheckPoints(double rmse, double check_points)
      : difference(std::hypot(rmse, check_points)), judged(std::hypot(difference, check_points)) {}
  double difference;
  // RMSE_V = sqrt(RMSE_V1^2 + RMSE_V2^2): V1 of the differences, V2 of the check points.
  double judged;
};

}  // namespace

void RmseTally::Add(const DryPoint& point) {
  horizontal_sigma_.Add(std::sqrt(point.variance_horizontal));
  vertical_sigma_.Add(std::sqrt(point.variance_vertical));
  horizontal_ += point.variance_horizontal;
  vertical_ += point.variance_vertical;
}

double RmseTally::horizontal() const { return std::sqrt(horizontal_ / static_cast<double>(points())); }
double RmseTally::vertical() const { return std::sqrt(vertical_ / static_cast<double>(points())); }

ordered_json RmseTally::Json() const {
  ordered_json json = {{"points", points()}};
  if (points() == 0) return json;
  json["sigma_horizontal"] = SigmaJson(horizontal_sigma_);
  json["sigma_vertical"] = SigmaJson(vertical_sigma_);
  json["rmse_horizontal"] = horizontal();
  json["rmse_vertical"] = vertical();
  json["rmse_3d"] = std::hypot(horizontal(), vertical());
  return json;
}

void LandTable::Add(const DryPoint& point) {
  if (point.of_water_surface) {
    ++water_surface_;
    return;
  }
  all_.Add(point);
  classes_[point.point_class].Add(point);
}

ordered_json LandTable::Json(const std::vector<Specification>& specifications, const CheckPointErrors& errors) const {
  if (empty()) return nullptr;
  const AgainstCheckPoints horizontal(all_.horizontal(), errors.horizontal);
  const AgainstCheckPoints vertical(all_.vertical(), errors.vertical);
  ordered_json json = all_.Json();
  json["water_surface_points"] = water_surface_;
  json["check_points"] = {{"rmse_horizontal", errors.horizontal}, {"rmse_vertical", errors.vertical}};
  json["against"] = {{"difference_horizontal", horizontal.difference},
                     {"difference_vertical", vertical.difference},
                     {"judged_horizontal", horizontal.judged},
                     {"judged_vertical", vertical.judged}};
  json["classes"] = ordered_json::array();
  for (const Specification& specification : specifications) {
    if (!specification.land) continue;
    for (const SpecificationClass& of : specification.classes) {
      const auto limit = [](const std::optional<Limit>& known) {
        return known.has_value() ? ordered_json(known->constant) : ordered_json();
      };
      const auto within = [](const std::optional<Limit>& known, double rmse) {
        return !known.has_value() || rmse <= known->constant;
      };
      json["classes"].push_back(
          {{"specification", specification.title},
           {"name", of.name},
           {"horizontal", limit(of.horizontal)},
           {"vertical", limit(of.vertical)},
           {"met", within(of.horizontal, horizontal.judged) && within(of.vertical, vertical.judged)}});
    }
  }
  json["by_class"] = ordered_json::array();
  for (const auto& [of_class, tally] : classes_) {
    ordered_json row = {{"class", of_class}};
    row.update(tally.Json());
    json["by_class"].push_back(std::move(row));
  }
  return json;
}

}  // namespace albtpu::quality
