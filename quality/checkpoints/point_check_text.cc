// What a check by points says, for programs and for people.
#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"
#include "quality/checkpoints/point_check.h"
#include "quality/crosscheck/cross_check.h"

namespace albtpu::quality {
namespace {

using Json = nlohmann::ordered_json;

Json FiniteOrNull(double number) { return std::isfinite(number) ? Json(number) : Json(); }

Json ValueWithInterval(const Estimate& estimate) {
  const bool bounded = std::isfinite(estimate.high);
  return {{"value", FiniteOrNull(estimate.value)},
          {"low", bounded ? FiniteOrNull(estimate.low) : Json()},
          {"high", bounded ? FiniteOrNull(estimate.high) : Json()}};
}

Json StatisticsJson(const DifferenceStatistics& of) {
  const bool several = of.points > 1;
  return {{"points", of.points},
          {"mean", ValueWithInterval(of.mean)},
          {"standard_error", of.standard_error},
          {"predicted_bias", of.bias},
          {"standard_deviation", several ? Json(of.deviation) : Json()},
          {"least", of.lowest},
          {"greatest", of.highest},
          {"percentile_95", of.percentile95},
          {"rmse", ValueWithInterval(of.rmse)},
          {"rmse_degrees_of_freedom", of.rmse_degrees},
          {"rmse_of_check_points", of.rmse_points},
          {"rmse_total", of.rmse_total()},
          {"z_squared", ValueWithInterval(of.squared_z)},
          {"z_squared_degrees_of_freedom", of.squared_z_degrees},
          {"within_predicted_95", of.within_predicted},
          {"within_tvu_95", of.within_tvu},
          {"scatter_factor", several ? ValueWithInterval(of.scatter) : Json()},
          {"scatter_differs", of.scatter_differs}};
}

Json OffsetJson(const DifferenceStatistics& of) {
  return {{"found", of.has_offset},
          {"value", of.offset()},
          {"predicted_by_lines", of.predicted_by_lines},
          {"predicted_by_survey", of.predicted_by_survey},
          {"z", FiniteOrNull(of.offset_z())},
          {"as_predicted", std::abs(of.offset_z()) <= kRareDifference}};
}

const char* WetOrDry(bool wet) { return wet ? "wet" : "dry"; }

// A row of the table.
std::string Row(const std::string& name, const DifferenceStatistics& of) {
  const auto interval = [](const Estimate& estimate, int digits) {
    return std::isfinite(estimate.high) ? absl::StrFormat("%.*f to %.*f", digits, estimate.low, digits, estimate.high)
                                        : std::string("-");
  };
  return absl::StrFormat("%-16s%7d%9.3f%9s%8.3f %-16s%7.3f%8.2f %-14s%5.0f %%\n", name.substr(0, 16), of.points,
                         of.mean.value, of.points > 1 ? absl::StrFormat("%.3f", of.deviation) : "-", of.rmse.value,
                         interval(of.rmse, 3), of.percentile95, of.squared_z.value, interval(of.squared_z, 2),
                         100 * of.within_tvu);
}

std::string OffsetText(const DifferenceStatistics& of) {
  return absl::StrFormat(
      "the survey lies %.3f m %s the check points (95 %% interval %+.3f to %+.3f m): an offset common to all, not "
      "scatter, %s what lines and the survey share explains (%.1f sigma of %.3f m)",
      std::abs(of.mean.value), of.mean.value < 0 ? "below" : "above", of.mean.low, of.mean.high,
      std::abs(of.offset_z()) <= kRareDifference ? "which" : "more than", std::abs(of.offset_z()),
      std::hypot(of.standard_error, of.predicted_by_survey));
}

// A cell of CSV, quoted where it has to be.
std::string Cell(const std::string& text) {
  if (text.find_first_of("\",\n\r") == std::string::npos) return text;
  return absl::StrCat("\"", absl::StrReplaceAll(text, {{"\"", "\"\""}}), "\"");
}

std::string Number(double number) { return absl::StrFormat("%.4f", number); }

}  // namespace

std::optional<bool> Agrees(const PointCheck& check) {
  const DifferenceStatistics& all = check.all;
  if (all.points < kFewestToTest) return std::nullopt;
  return !all.scatter_differs && !(all.has_offset && std::abs(all.offset_z()) > kRareDifference);
}

std::string Conclusion(const PointCheck& check) {
  const DifferenceStatistics& all = check.all;
  const std::optional<bool> agrees = Agrees(check);
  if (!agrees.has_value())
    return absl::StrFormat("%d check points with a surface are too few to test the prediction (%d at least)",
                           all.points, kFewestToTest);
  const std::string about = all.has_offset ? " about it" : "";
  const std::string scatter =
      !all.scatter_differs
          ? absl::StrCat("differences scatter", about, " as predicted")
          : absl::StrFormat(
                "differences scatter%s %.2f times as much as predicted (95 %% interval %.2f to %.2f): the "
                "prediction is too %s",
                about, all.scatter.value, all.scatter.low, all.scatter.high, all.scatter.value > 1 ? "small" : "large");
  const std::string offset = all.has_offset
                                 ? OffsetText(all)
                                 : absl::StrFormat("no offset is found (mean %+.3f m, 95 %% interval %+.3f to %+.3f m)",
                                                   all.mean.value, all.mean.low, all.mean.high);
  return absl::StrCat(*agrees ? "prediction and check points agree: " : "check points contradict the prediction: ",
                      all.has_offset ? offset : scatter, "; ", all.has_offset ? scatter : offset);
}

Json PointCheckJson(const PointCheck& check) {
  const std::optional<bool> agrees = Agrees(check);
  Json json = {
      {"conclusion", Conclusion(check)},
      {"agrees", agrees.has_value() ? Json(*agrees) : Json()},
      {"radius", check.radius},
      {"check_points", check.list.points.size()},
      {"without_points", check.without_surface()},
      {"sigma_stated", {{"horizontal", check.list.horizontal_stated}, {"vertical", check.list.vertical_stated}}},
      {"asprs_points", kPointsOfAsprs},
      {"offset", OffsetJson(check.all)},
      {"all", StatisticsJson(check.all)},
      {"by_class", Json::array()},
      {"by_depth", Json::array()}};
  for (const PointGroup& group : check.by_class) {
    Json of = {{"of", WetOrDry(group.wet)}, {"class", group.kind.empty() ? Json() : Json(group.kind)}};
    of.update(StatisticsJson(group.statistics));
    json["by_class"].push_back(std::move(of));
  }
  for (const PointGroup& group : check.by_depth) {
    Json of = {{"from", group.from}, {"to", FiniteOrNull(group.to)}};
    of.update(StatisticsJson(group.statistics));
    json["by_depth"].push_back(std::move(of));
  }
  if (!check.left_out.empty()) json["left_out"] = LeftOutJson(check.left_out);
  return json;
}

std::string PointCheckText(const PointCheck& check) {
  const DifferenceStatistics& all = check.all;
  std::string text =
      absl::StrFormat("%s\n%d check points, surface less check point in m", Conclusion(check), all.points);
  if (check.without_surface() > 0)
    absl::StrAppendFormat(&text, "; no surface there (fewer than %d points within %g m, or all on one line): %d more",
                          kFewestPoints, check.radius, check.without_surface());
  absl::StrAppendFormat(&text, "\n%-16s%7s%9s%9s%8s %-16s%7s%8s %-14s%7s\n", "", "points", "mean", "std.dev", "RMSE",
                        "95 % interval", "95 %", "z^2", "95 % interval", "in TVU");
  absl::StrAppend(&text, Row("all", all));
  if (check.by_class.size() > 1 || !check.by_class.front().wet)
    for (const PointGroup& group : check.by_class)
      absl::StrAppend(
          &text, Row(absl::StrCat(WetOrDry(group.wet), group.kind.empty() ? "" : " ", group.kind), group.statistics));
  if (check.by_depth.size() > 1)
    for (const PointGroup& group : check.by_depth)
      absl::StrAppend(&text, Row(std::isfinite(group.to) ? absl::StrFormat("%g to %g m", group.from, group.to)
                                                         : absl::StrFormat("from %g m", group.from),
                                 group.statistics));
  absl::StrAppendFormat(
      &text,
      "of the mean: standard error %.3f m without what all points share, %.3f m predicted of that (calibration, water "
      "level, datum), bias %+.3f m\n"
      "degrees of freedom: %.1f of the RMSE, %.1f of z^2, whose points share lines and the survey\n"
      "ASPRS edition 2: RMSE_V = sqrt(%.3f^2 + %.3f^2) = %.3f m, with the check points' own error; %d of the %d check "
      "points that it asks for\n",
      all.standard_error, all.predicted_by_survey, all.bias, all.rmse_degrees, all.squared_z_degrees, all.rmse.value,
      all.rmse_points, all.rmse_total(), all.points, kPointsOfAsprs);
  if (!check.list.vertical_stated)
    absl::StrAppend(&text,
                    "errors of some or all check points are not stated, and taken as 0: give --point-sigma-vertical\n");
  if (!check.left_out.empty()) absl::StrAppend(&text, LeftOutText(check.left_out), "\n");
  return text;
}

std::string PointCheckCsv(const PointCheck& check) {
  std::string text =
      "id,class,x,y,elevation,surface,difference,predicted_bias,sigma,z,sigma_pulse_sea,sigma_lines,sigma_survey,"
      "sigma_check_point,tvu_95,water,depth,points,passes\n";
  auto next = check.surfaces.begin();
  for (std::size_t i = 0; i < check.list.points.size(); ++i) {
    const CheckPoint& point = check.list.points[i];
    absl::StrAppend(&text, Cell(point.id), ",", Cell(point.kind), ",", absl::StrFormat("%.3f,%.3f,", point.x, point.y),
                    Number(point.elevation), ",");
    if (next == check.surfaces.end() || next->point != i) {
      absl::StrAppend(&text, ",,,,,,,,,,,,0,0\n");
      continue;
    }
    const Difference& d = check.differences[static_cast<std::size_t>(next - check.surfaces.begin())];
    const NodeVariance& variance = next->node.variance;
    const double lidar = variance.pulse + variance.sea, sigma = std::sqrt(d.variance());
    absl::StrAppend(&text, Number(next->node.elevation), ",", Number(d.difference), ",", Number(d.bias), ",",
                    Number(sigma), ",", Number((d.difference - d.bias) / sigma), ",", Number(std::sqrt(lidar)), ",",
                    Number(std::sqrt(std::max(d.variance() - d.own - d.survey * d.survey, 0.0))), ",", Number(d.survey),
                    ",", Number(std::sqrt(std::max(d.own - lidar, 0.0))), ",", Number(d.tvu), ",", WetOrDry(next->wet),
                    ",", next->wet ? Number(next->node.depth) : "", ",", next->node.points, ",", variance.passes, "\n");
    ++next;
  }
  return text;
}

}  // namespace albtpu::quality
