#include "quality/planning/survey_plan.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"
#include "annotate/totals/pulse_totals.h"
#include "annotate/totals/water_column.h"
#include "status/status_macros.h"

namespace albtpu::quality {
namespace {

annotate::PulseBatch PulsesOf(const PlannedBeam& beam, double greatest_depth) {
  annotate::PulseBatch pulses;
  const auto set = [&](AxisId axis, std::optional<double> value) {
    if (value.has_value()) pulses[axis] = {static_cast<float>(*value)};
  };
  set(AxisId::kWindSpeed, beam.wind_speed);
  set(AxisId::kFetch, beam.fetch);
  set(AxisId::kIncidence, beam.incidence);
  set(AxisId::kFootprint, beam.footprint);
  for (double depth = kReachStep; depth <= greatest_depth; depth += kReachStep)
    pulses[AxisId::kDepth].push_back(static_cast<float>(depth));
  pulses.size = pulses[AxisId::kDepth].size();
  return pulses;
}

}  // namespace

absl::StatusOr<Reaches> ReachOf(const annotate::TotalPlan& plan, const annotate::AnswerSource& source,
                                const PlannedBeam& beam) {
  const annotate::PulseBatch pulses = PulsesOf(beam, source.table().axes[Index(AxisId::kDepth)].last);
  annotate::AnswerSelection selection;
  annotate::SelectForTotals(selection);
  annotate::AnswerBatch sea;
  RETURN_IF_ERROR(annotate::AnswerPulses(source, {}, pulses, selection, sea));
  annotate::TotalBatch totals;
  annotate::AddWater(plan.water, pulses, sea, totals.water);
  AircraftColumns aircraft;
  aircraft[BudgetInput::kAltitude] = {static_cast<float>(beam.altitude)};
  annotate::ComputeTotals(plan, pulses, sea, aircraft, totals);
  Reaches reaches;
  for (std::size_t order = 0; order < reaches.size(); ++order) {
    Reach& reach = reaches[order];
    reach.limit = ReachLimit::kTable;  // Unless something else comes first.
    for (std::size_t i = 0; i < pulses.size; ++i) {
      if (!sea.interpolated(i)) {
        reach.limit = sea.outcomes[i] == annotate::kNoWater ? ReachLimit::kWater : ReachLimit::kTable;
        break;
      }
      const double depth = pulses.coordinate(AxisId::kDepth, i);
      if (totals.best_orders[i] == 0 || totals.best_orders[i] > order + 1) {
        const float bias = sea[Quantity::kBiasVertical][i];
        const double tvu = totals.tvu[i] + (std::isfinite(bias) ? std::abs(bias) : 0);
        reach.limit = tvu > TvuLimit(kS44Orders[order], depth) ? ReachLimit::kTvu : ReachLimit::kThu;
        break;
      }
      reach.depth = depth;
    }
  }
  return reaches;
}

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<double, 8> kAskedDepths = {1, 2, 5, 10, 15, 20, 30, 40};  // m

const Reach& Of(const Reaches& reaches, S44Order order) { return reaches[static_cast<std::size_t>(order)]; }

Json DepthJson(const Reach& reach) { return reach.is_known() ? Json(reach.depth) : Json(); }

std::string LimitName(const Reach& reach) {
  return std::string(kReachLimitNames[static_cast<std::size_t>(reach.limit)]);
}

Json AxisJson(const PlannedAxis& axis) {
  Json json = {{"name", axis.name}, {"unit", axis.unit}, {"values", axis.values}};
  for (const S44Order order : kS44Orders) {
    const std::string name(Name(order));
    for (const std::vector<Reaches>& by_sea : axis.reaches) {
      Json depths = Json::array(), limits = Json::array();
      for (const Reaches& reaches : by_sea) {
        depths.push_back(DepthJson(Of(reaches, order)));
        limits.push_back(LimitName(Of(reaches, order)));
      }
      json["depth"][name].push_back(std::move(depths));
      json["limited_by"][name].push_back(std::move(limits));
    }
  }
  return json;
}

}  // namespace

std::optional<double> HighestSea(const SurveyPlan& plan, S44Order order, double depth) {
  std::optional<double> greatest;
  for (std::size_t i = 0; i < plan.seas.size() && Of(plan.planned[i], order).depth >= depth; ++i)
    greatest = plan.seas[i];
  return greatest;
}

Json PlanJson(const SurveyPlan& plan) {
  Json json = {{"program", "albtpu-query"},
               {"order", std::string(Name(plan.order))},
               {"sea", {{"name", plan.sea_name}, {"unit", plan.sea_unit}}},
               {"seas", plan.seas},
               {"conditions", {{"altitude", plan.altitude}, {"incidence", plan.incidence}}},
               {"planned", Json::array()},
               {"greatest_sea", Json::array()},
               {"axes", Json::array()},
               {"numbers", Json::array()}};
  for (const Reaches& reaches : plan.planned) {
    Json of_sea;
    for (const S44Order order : kS44Orders) {
      of_sea["depth"][std::string(Name(order))] = DepthJson(Of(reaches, order));
      of_sea["limited_by"][std::string(Name(order))] = LimitName(Of(reaches, order));
    }
    json["planned"].push_back(std::move(of_sea));
  }
  for (const double depth : kAskedDepths) {
    Json of_depth = {{"depth", depth}};
    for (const S44Order order : kS44Orders) {
      const std::optional<double> sea = HighestSea(plan, order, depth);
      of_depth[std::string(Name(order))] = sea.has_value() ? Json(*sea) : Json();
    }
    json["greatest_sea"].push_back(std::move(of_depth));
  }
  for (const PlannedAxis& axis : plan.axes) json["axes"].push_back(AxisJson(axis));
  for (const annotate::StatedNumber& number : plan.numbers) {
    json["numbers"].push_back(
        {{"name", number.name}, {"value", number.value}, {"source", number.source}, {"assumed", number.assumed}});
  }
  return json;
}

std::string PlanText(const SurveyPlan& plan) {
  const std::string sea = absl::StrReplaceAll(plan.sea_name, {{"_", " "}});
  std::string text = absl::StrCat("depth in m down to which each order of S-44 is met, by ", sea, ";");
  absl::StrAppend(&text, " altitude ", Json(plan.altitude).dump(), " incidence ", Json(plan.incidence).dump());
  absl::StrAppendFormat(&text, "\n%10s", plan.sea_unit);
  for (const S44Order order : kS44Orders) absl::StrAppendFormat(&text, "%11s", std::string(Name(order)));
  absl::StrAppendFormat(&text, "  limit of %s\n", std::string(Name(plan.order)));
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
  for (const annotate::StatedNumber& number : plan.numbers)
    if (number.assumed) absl::StrAppend(&text, "  ", number.name, " ", number.value, " (", number.source, ")\n");
  return text;
}

}  // namespace albtpu::quality
