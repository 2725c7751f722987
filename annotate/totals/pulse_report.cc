#include "annotate/totals/pulse_report.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "annotate/answers/answer_counts.h"
#include "annotate/totals/pulse_totals.h"
#include "budget/air/air_sources.h"
#include "budget/total/error_ellipse.h"
#include "formats/text/text.h"
#include "status/status_macros.h"

namespace albtpu::annotate {
namespace {

using nlohmann::ordered_json;

// Of the one pulse; what needs its direction only where that is known.
ordered_json CovarianceJson(const TotalBatch::Covariance& covariance, bool directed) {
  ordered_json json;
  for (std::size_t i = 0; i < covariance.size(); ++i) {
    const bool vertical = kCovarianceNames[i] == "DD";
    json[std::string(kCovarianceNames[i])] =
        directed || vertical ? formats::JsonNumber(covariance[i][0]) : ordered_json();
  }
  return json;
}

ordered_json NumberOrNull(float number) { return std::isfinite(number) ? formats::JsonNumber(number) : ordered_json(); }

void SetMotion(const PulseMotion& motion, AircraftColumns& aircraft) {
  const auto set = [&](BudgetInput first, const std::optional<std::array<double, 3>>& given) {
    for (std::size_t i = 0; given.has_value() && i < 3; ++i) aircraft[first + i] = {static_cast<float>((*given)[i])};
  };
  set(BudgetInput::kRoll, motion.attitude);
  set(BudgetInput::kVelocityNorth, motion.velocity);
  set(BudgetInput::kRollRate, motion.rates);
}

// Of each source of the air side.
ordered_json SourcesJson(const PulseTotal& total) {
  const auto vector = [](const std::optional<std::array<double, 3>>& given) {
    return given.has_value() ? Eigen::Vector3d(given->data()) : Eigen::Vector3d(Eigen::Vector3d::Zero());
  };
  const Eigen::Vector3d attitude = vector(total.motion.attitude);
  const AirPulse pulse = {.incidence = total.pulse.coordinate(AxisId::kIncidence, 0),
                          .beam_azimuth = total.beam_azimuth.value_or(0),
                          .altitude = total.altitude,
                          .depth = total.pulse.coordinate(AxisId::kDepth, 0),
                          .roll = attitude[0],
                          .pitch = attitude[1],
                          .heading = attitude[2],
                          .velocity = vector(total.motion.velocity),
                          .rates = vector(total.motion.rates),
                          .lever_arm = Eigen::Vector3d(total.plan.options.lever_arm.data()),
                          .index = total.plan.options.index};
  ordered_json json;
  for (const AirSource& source : AirSources(pulse, total.plan.options.located, total.plan.options.errors)) {
    const Eigen::Matrix3d c = source.Covariance();
    json[std::string(source.name)] = {{"horizontal", c(0, 0) + c(1, 1)},
                                      {"vertical", c(2, 2)},
                                      {"group", std::string(kErrorGroupNames[static_cast<std::size_t>(source.group)])}};
  }
  return json;
}

// What the water column does before any treatment, and what is left; null beyond the table.
ordered_json WaterJson(const WaterPlan& plan, const PulseBatch& pulse) {
  const std::optional<WaterAnswerOfSurvey> answer =
      plan.share->At(pulse.coordinate(AxisId::kIncidence, 0), pulse.coordinate(AxisId::kDepth, 0));
  if (!answer.has_value()) return {{"greatest_depth", plan.share->greatest_depth()}};
  return {{"water_bias_vertical", answer->mean_vertical},
          {"water_bias_vertical_sigma", answer->sigma_vertical},
          {"water_bias_vertical_interval", {answer->low_vertical, answer->high_vertical}},
          {"water_bias_along_beam", answer->mean_along},
          {"water_bias_along_beam_sigma", answer->sigma_along},
          {"left_in_bias_vertical", answer->bias_vertical},
          {"left_in_bias_along_beam", answer->bias_along},
          {"spot", answer->spot},
          {"stretch", answer->stretch},
          {"energy", answer->energy},
          {"greatest_depth", plan.share->greatest_depth()},
          {"greatest_incidence", plan.share->greatest_incidence()}};
}

}  // namespace

absl::StatusOr<ordered_json> TotalJson(const PulseTotal& total, const AnswerSource& source) {
  AnswerSelection selection;
  SelectForTotals(selection);
  AnswerBatch sea;
  RETURN_IF_ERROR(AnswerPulses(source, {}, total.pulse, selection, sea));
  TotalBatch totals;
  totals.whole = true;
  const WaterBatch& water = totals.water;
  AddWater(total.plan.water, total.pulse, sea, totals.water);
  AircraftColumns aircraft;
  aircraft[BudgetInput::kAltitude] = {total.altitude};
  if (total.beam_azimuth.has_value()) aircraft[BudgetInput::kBeamAzimuth] = {*total.beam_azimuth};
  SetMotion(total.motion, aircraft);
  ComputeTotals(total.plan, total.pulse, sea, aircraft, totals);

  const bool directed = total.beam_azimuth.has_value(), with_water = total.plan.water.has_share();
  ordered_json json = {{"thu", NumberOrNull(totals.thu[0])},
                       {"tvu", NumberOrNull(totals.tvu[0])},
                       {"coverage", CoverageName(total.plan.options.coverage)},
                       {"outcome", std::string(OutcomeName(sea, 0))},
                       {"covariance_air", CovarianceJson(totals.air, directed)},
                       {"covariance_sea", CovarianceJson(totals.sea, directed)},
                       {"covariance_water", with_water ? CovarianceJson(totals.of_water, directed) : ordered_json()},
                       {"covariance_total", CovarianceJson(totals.covariance, directed)},
                       {"thu_air", NumberOrNull(totals.thu_air[0])},
                       {"tvu_air", NumberOrNull(totals.tvu_air[0])},
                       {"thu_sea", NumberOrNull(totals.thu_sea[0])},
                       {"tvu_sea", NumberOrNull(totals.tvu_sea[0])},
                       {"thu_water", with_water ? NumberOrNull(totals.thu_water[0]) : ordered_json()},
                       {"tvu_water", with_water ? NumberOrNull(totals.tvu_water[0]) : ordered_json()}};
  const TotalBatch::Covariance& all = totals.covariance;
  const HorizontalEllipse ellipse = EllipseOf(all[0][0], all[1][0], all[3][0]);
  json["semi_major"] = directed ? NumberOrNull(static_cast<float>(ellipse.semi_major)) : ordered_json();
  json["semi_minor"] = directed ? NumberOrNull(static_cast<float>(ellipse.semi_minor)) : ordered_json();
  json["major_azimuth"] = directed ? NumberOrNull(static_cast<float>(ellipse.major_azimuth)) : ordered_json();
  json["bias_along_beam"] = NumberOrNull(sea[Quantity::kBiasAlongBeam][0]);
  json["bias_vertical"] = NumberOrNull(sea[Quantity::kBiasVertical][0]);
  const std::uint8_t best = totals.best_orders[0];
  json["s44_order_met"] = best > 0 ? ordered_json(std::string(Name(kS44Orders[best - 1]))) : ordered_json();
  json["sources"] = SourcesJson(total);
  json["sources"]["datum"] = {
      {"horizontal", 0}, {"vertical", std::pow(total.plan.options.datum, 2)}, {"group", "survey"}};
  const BudgetOptions& options = total.plan.options;
  if (total.plan.has_extra()) {
    json["sources"]["extra"] = {{"horizontal", std::pow(options.extra_horizontal, 2)},
                                {"vertical", std::pow(options.extra_vertical, 2)},
                                {"group", "survey"}};
  }
  json["sources"]["sea"] = {{"horizontal", NumberOrNull(totals.sea[0][0] + totals.sea[1][0])},
                            {"vertical", NumberOrNull(totals.sea[2][0])},
                            {"group", "pulse"}};
  if (with_water) {
    const double noise = std::pow(water.noise[0], 2);
    json["sources"]["water"] = {{"horizontal", NumberOrNull(water.sigma_along[0] * water.sigma_along[0])},
                                {"vertical", NumberOrNull(water.sigma_vertical[0] * water.sigma_vertical[0])},
                                {"group", "survey"}};
    if (total.plan.water.share != nullptr && total.plan.water.photons.has_value())
      json["sources"]["photons"] = {
          {"horizontal", totals.of_water[0][0] + totals.of_water[1][0] - water.sigma_along[0] * water.sigma_along[0]},
          {"vertical", noise},
          {"group", "pulse"}};
    if (total.plan.water.share != nullptr) json["water"] = WaterJson(total.plan.water, total.pulse);
  }
  for (std::size_t g = 0; g < kErrorGroups; ++g)
    json["groups"][std::string(kErrorGroupNames[g])] = CovarianceJson(totals.groups[g], directed);
  json["plan"] = Parameters(total.plan);
  json["assumed"] = Assumptions(total.plan);
  if (!total.motion.attitude.has_value()) json["assumed"].push_back("attitude of level flight to the north");
  if (!total.motion.velocity.has_value()) json["assumed"].push_back("velocity 0");
  json["table"] = source.table().id;
  json["version"] = source.table().version;
  json["digest"] = source.table().digest;
  return json;
}

std::string TotalText(const ordered_json& total) {
  const auto number = [](const ordered_json& value) {
    return value.is_number() ? absl::StrFormat("%.4g", value.get<double>()) : std::string("no number");
  };
  std::string text =
      absl::StrFormat("total THU %s m, TVU %s m, %s; outcome %s\n", number(total["thu"]), number(total["tvu"]),
                      total["coverage"].get<std::string>(), total["outcome"].get<std::string>());
  absl::StrAppend(&text, "order of S-44 met: ",
                  total["s44_order_met"].is_string() ? total["s44_order_met"].get<std::string>() : "none",
                  " (at 95 %, biases added)\n");
  absl::StrAppend(&text, absl::StrFormat("bias along the beam %s m, vertical %s m\n", number(total["bias_along_beam"]),
                                         number(total["bias_vertical"])));
  if (const auto water = total.find("water"); water != total.end() && water->contains("spot")) {
    absl::StrAppend(
        &text, absl::StrFormat(
                   "water column: bias vertical %s m, %s to %s m with 95 %%; along the beam %s m\n",
                   number((*water)["water_bias_vertical"]), number((*water)["water_bias_vertical_interval"][0]),
                   number((*water)["water_bias_vertical_interval"][1]), number((*water)["water_bias_along_beam"])));
  }
  if (const std::string water = WaterText(total["plan"]); !water.empty()) absl::StrAppend(&text, water, "\n");
  absl::StrAppend(
      &text, absl::StrFormat("\n%-16s %-8s %18s %18s\n", "source", "group", "horizontal, m", "vertical, m (1 sigma)"));
  for (const auto& [name, source] : total["sources"].items()) {
    const auto root = [&, &given = source](const char* axis) {
      return given[axis].is_number() ? absl::StrFormat("%.4f", std::sqrt(given[axis].get<double>()))
                                     : std::string("no number");
    };
    absl::StrAppend(&text, absl::StrFormat("%-16s %-8s %18s %18s\n", name, source["group"].get<std::string>(),
                                           root("horizontal"), root("vertical")));
  }
  absl::StrAppend(&text, "\nassumed:\n");
  for (const ordered_json& assumed : total["assumed"]) absl::StrAppend(&text, "  ", assumed.get<std::string>(), "\n");
  return text;
}

}  // namespace albtpu::annotate
