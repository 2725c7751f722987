#include "quality/planning/survey_plan.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "annotate/totals/pulse_totals.h"
#include "annotate/totals/water_column.h"
#include "sea/sea_time.h"
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
  if (beam.time.has_value()) pulses.times.assign(pulses.size, *beam.time);
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

Json DepthJson(const Reach& reach) { return reach.is_known() ? Json(reach.depth) : Json(); }

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

Json HoursJson(const PlannedHours& hours, const std::vector<Reaches>& planned) {
  Json json = {{"first", SeaTimeText(hours.first)}, {"last", SeaTimeText(hours.last)}, {"count", planned.size()},
               {"without_sea", hours.without_sea},  {"tides", "not considered"},       {"by_depth", Json::array()}};
  for (const double depth : kAskedDepths) {
    Json of_depth = {{"depth", depth}};
    for (const S44Order order : kS44Orders) {
      const HoursMet of = ShareOfHours(planned, order, depth);
      of_depth["share"][std::string(Name(order))] = of.met;
      of_depth["no_answer"][std::string(Name(order))] = of.unknown;
    }
    json["by_depth"].push_back(std::move(of_depth));
  }
  return json;
}

Json AxisOfHoursJson(const PlannedAxis& axis) {
  Json json = {{"name", axis.name}, {"unit", axis.unit}, {"values", axis.values}};
  for (const S44Order order : kS44Orders)
    for (const std::vector<Reaches>& by_hour : axis.reaches) {
      Json shares = Json::array();
      for (const double depth : kAskedDepths) shares.push_back(ShareOfHours(by_hour, order, depth).met);
      json["share"][std::string(Name(order))].push_back(std::move(shares));
    }
  return json;
}

}  // namespace

HoursMet ShareOfHours(const std::vector<Reaches>& by_hour, S44Order order, double depth) {
  HoursMet hours;
  if (by_hour.empty()) return hours;
  const double share = 1 / static_cast<double>(by_hour.size());
  for (const Reaches& reaches : by_hour) {
    const Reach& reach = Of(reaches, order);
    if (reach.depth >= depth)
      hours.met += share;
    else if (reach.limit == ReachLimit::kTable || reach.limit == ReachLimit::kWater)
      hours.unknown += share;
  }
  return hours;
}

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
  if (plan.hours.has_value()) json["hours"] = HoursJson(*plan.hours, plan.planned);
  const std::vector<Reaches> none;
  for (const Reaches& reaches : plan.hours.has_value() ? none : plan.planned) {
    Json of_sea;
    for (const S44Order order : kS44Orders) {
      of_sea["depth"][std::string(Name(order))] = DepthJson(Of(reaches, order));
      of_sea["limited_by"][std::string(Name(order))] = LimitName(Of(reaches, order));
    }
    json["planned"].push_back(std::move(of_sea));
  }
  for (const double depth : kAskedDepths) {
    if (plan.hours.has_value()) break;
    Json of_depth = {{"depth", depth}};
    for (const S44Order order : kS44Orders) {
      const std::optional<double> sea = HighestSea(plan, order, depth);
      of_depth[std::string(Name(order))] = sea.has_value() ? Json(*sea) : Json();
    }
    json["greatest_sea"].push_back(std::move(of_depth));
  }
  for (const PlannedAxis& axis : plan.axes)
    json["axes"].push_back(plan.hours.has_value() ? AxisOfHoursJson(axis) : AxisJson(axis));
  json["located"] = plan.located;
  for (const annotate::StatedNumber& number : plan.numbers) {
    json["numbers"].push_back(
        {{"name", number.name}, {"value", number.value}, {"source", number.source}, {"assumed", number.assumed}});
  }
  return json;
}

}  // namespace albtpu::quality
