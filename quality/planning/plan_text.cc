// A plan as text.
#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"
#include "quality/planning/survey_plan.h"
#include "sea/sea_time.h"

namespace albtpu::quality {
namespace {

std::string Planned(const SurveyPlan& plan) {
  return absl::StrCat("altitude ", nlohmann::json(plan.altitude).dump(), " incidence ",
                      nlohmann::json(plan.incidence).dump());
}

std::string OrderNames() {
  std::string text;
  for (const S44Order order : kS44Orders) absl::StrAppendFormat(&text, "%11s", std::string(Name(order)));
  return text;
}

// The depths of the required order, over one of the conditions and the sea.
std::string AxisOfSeas(const SurveyPlan& plan, const PlannedAxis& axis, const std::string& sea) {
  std::string text = absl::StrFormat("order %s by %s [%s, down] and %s [%s, across]:\n%10s",
                                     std::string(Name(plan.order)), axis.name, axis.unit, sea, plan.sea_unit, "");
  for (const double each : plan.seas) absl::StrAppendFormat(&text, "%7g", each);
  for (std::size_t i = 0; i < axis.values.size(); ++i) {
    absl::StrAppendFormat(&text, "\n%10g", axis.values[i]);
    for (const Reaches& reaches : axis.reaches[i]) {
      const Reach& reach = Of(reaches, plan.order);
      absl::StrAppendFormat(&text, "%7s", reach.is_known() ? absl::StrFormat("%.2f", reach.depth) : "-");
    }
  }
  return text + "\n";
}

std::string DepthNames() {
  std::string text;
  for (const double depth : kAskedDepths) absl::StrAppendFormat(&text, "%7s", absl::StrFormat("%g m", depth));
  return text;
}

// The same of hours: their share down to each depth.
std::string AxisOfHours(const SurveyPlan& plan, const PlannedAxis& axis) {
  std::string text = absl::StrFormat("share of hours for order %s by %s [%s, down], down to\n%10s%s",
                                     std::string(Name(plan.order)), axis.name, axis.unit, "", DepthNames());
  for (std::size_t i = 0; i < axis.values.size(); ++i) {
    absl::StrAppendFormat(&text, "\n%10g", axis.values[i]);
    for (const double depth : kAskedDepths)
      absl::StrAppendFormat(&text, "%5.0f %%", 100 * ShareOfHours(axis.reaches[i], plan.order, depth).met);
  }
  return text + "\n";
}

std::string OfHours(const SurveyPlan& plan) {
  const PlannedHours& hours = *plan.hours;
  std::string text =
      absl::StrFormat("share of %d hours from %s to %s in which each order of S-44 is met, tides aside; %s\n",
                      plan.planned.size(), SeaTimeText(hours.first), SeaTimeText(hours.last), Planned(plan));
  if (hours.without_sea > 0)
    absl::StrAppendFormat(&text, "%d hours more have no sea, in gaps of the file\n", hours.without_sea);
  absl::StrAppendFormat(&text, "%10s%s\n", "down to", OrderNames());
  bool unknown = false;
  for (const double depth : kAskedDepths) {
    absl::StrAppendFormat(&text, "%8g m", depth);
    for (const S44Order order : kS44Orders) {
      const HoursMet of = ShareOfHours(plan.planned, order, depth);
      absl::StrAppendFormat(&text, "%8.1f %%%s", 100 * of.met, of.unknown > 0 ? "+" : " ");
      unknown |= of.unknown > 0;
    }
    text += "\n";
  }
  if (unknown) text += "+: in some hours no table answers so deep; they count as not met\n";
  for (const PlannedAxis& axis : plan.axes) text += AxisOfHours(plan, axis);
  return text;
}

std::string OfSeas(const SurveyPlan& plan) {
  const std::string sea = absl::StrReplaceAll(plan.sea_name, {{"_", " "}});
  std::string text =
      absl::StrFormat("depth in m down to which each order of S-44 is met, by %s; %s\n%10s%s  limit of %s\n", sea,
                      Planned(plan), plan.sea_unit, OrderNames(), std::string(Name(plan.order)));
  for (std::size_t i = 0; i < plan.seas.size(); ++i) {
    absl::StrAppendFormat(&text, "%10g", plan.seas[i]);
    for (const S44Order order : kS44Orders) {
      const Reach& reach = Of(plan.planned[i], order);
      absl::StrAppendFormat(&text, "%11s", reach.is_known() ? absl::StrFormat("%.2f", reach.depth) : "-");
    }
    absl::StrAppend(&text, "  ", LimitName(Of(plan.planned[i], plan.order)), "\n");
  }
  absl::StrAppend(&text, "greatest ", sea, " for order ", std::string(Name(plan.order)), ":");
  for (const double depth : kAskedDepths) {
    const std::optional<double> greatest = HighestSea(plan, plan.order, depth);
    absl::StrAppend(&text, depth == kAskedDepths.front() ? " " : ", ",
                    greatest.has_value() ? absl::StrCat(*greatest, " ", plan.sea_unit) : "none", " to ", depth, " m");
  }
  absl::StrAppend(&text, "\n");
  for (const PlannedAxis& axis : plan.axes) text += AxisOfSeas(plan, axis, sea);
  return text;
}

}  // namespace

std::string PlanText(const SurveyPlan& plan) {
  std::string text = plan.hours.has_value() ? OfHours(plan) : OfSeas(plan);
  absl::StrAppend(&text, "  surface located: ", plan.located, " (", plan.located_by, ")\n");
  for (const annotate::StatedNumber& number : plan.numbers)
    if (number.assumed) absl::StrAppend(&text, "  ", number.name, " ", number.value, " (", number.source, ")\n");
  return text;
}

}  // namespace albtpu::quality
