// What a cross-check says, for programs and for people.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "quality/crosscheck/cross_check.h"

namespace albtpu::quality {
namespace {

using Json = nlohmann::ordered_json;

Json NumberJson(double number) { return std::isfinite(number) ? Json(number) : Json(); }

Json EstimateJson(const Estimate& estimate) {
  Json json = {{"value", NumberJson(estimate.value)}, {"low", nullptr}, {"high", nullptr}};
  if (std::isfinite(estimate.high)) json["low"] = estimate.low, json["high"] = estimate.high;
  return json;
}

Json BandsJson(const std::vector<CrossBand>& bands) {
  Json list = Json::array();
  for (const CrossBand& band : bands)
    list.push_back(
        {{"from", band.from}, {"to", NumberJson(band.to)}, {"pairs", band.pairs}, {"chi_square", band.chi_square}});
  return list;
}

Json LinesJson(const std::vector<LineDifference>& lines) {
  Json list = Json::array();
  for (const LineDifference& line : lines) {
    list.push_back({{"a", line.line_a},
                    {"b", line.line_b},
                    {"pairs", line.pairs},
                    {"mean_difference", line.mean},
                    {"standard_error", line.standard_error},
                    {"predicted", line.predicted},
                    {"z", line.z()},
                    {"as_predicted", std::abs(line.z()) <= kRareDifference}});
    if (std::isfinite(line.begin_a)) list.back()["a_begin"] = line.begin_a;
    if (std::isfinite(line.begin_b)) list.back()["b_begin"] = line.begin_b;
  }
  return list;
}

std::string EstimateText(const Estimate& estimate) {
  if (!std::isfinite(estimate.value)) return "not known: too few pairs are close together";
  if (!std::isfinite(estimate.high)) return absl::StrFormat("%.2f (one place gives no interval)", estimate.value);
  if (estimate.value < 0.005) return absl::StrFormat("0: no such error shows (95 %%: at most %.2f)", estimate.high);
  return absl::StrFormat("%.2f (95 %%: %.2f to %.2f)", estimate.value, estimate.low, estimate.high);
}

// Of many pairs too, no standard error is 0.
std::string ErrorText(double metres) {
  return metres < 0.0005 ? absl::StrFormat("%.1g m", metres) : absl::StrFormat("%.3f m", metres);
}

// A difference of two lines in units of what is predicted of it.
std::string DifferenceText(const LineDifference& line) {
  return absl::StrFormat("%s lies %.3f m %s %s: %.1f sigma, %s (%d pairs; standard error %s, trajectories %.3f m)\n",
                         NameOf(FlightLine{line.line_a, line.begin_a}), std::abs(line.mean),
                         line.mean < 0 ? "below" : "above", NameOf(FlightLine{line.line_b, line.begin_b}),
                         std::abs(line.z()),
                         std::abs(line.z()) > kRareDifference ? "more than predicted" : "as predicted", line.pairs,
                         ErrorText(line.standard_error), line.predicted);
}

}  // namespace

std::optional<bool> Agrees(const CrossCheck& check) {
  if (!check.guilty.empty()) return false;
  const bool tested = std::isfinite(check.pulse.factor.high) ||
                      (check.line.factor.has_value() && std::isfinite(check.line.factor->high));
  return tested ? std::optional(true) : std::nullopt;
}

std::string Conclusion(const CrossCheck& check) {
  const std::optional<bool> agrees = Agrees(check);
  if (!agrees.has_value()) return "too few pairs of overlapping lines are close together to test the prediction";
  if (*agrees)
    return absl::StrFormat("prediction and overlap agree: no part differs by %.0f %% and beyond an interval of 99.5 %%",
                           100 * kMinDifference);
  const Estimate& factor = check.guilty == "trajectory" ? *check.line.factor : check.pulse.factor;
  const char* part = "pulses";
  const char* reason = "";
  if (check.guilty == "trajectory") {
    part = "the trajectory";
  } else if (check.guilty == "sea") {
    part = "the sea surface";
  } else if (check.guilty == "air") {
    part = "the sensor";
    reason = " (scan angles or ranges, or a trajectory whose errors change within seconds)";
  } else {
    reason = check.sea_known ? "; of the sensor or of the sea, these pairs cannot tell"
                             : "; of the sensor or of the sea, these pairs cannot tell without the sea: give it by "
                               "--survey or flags";
  }
  return absl::StrCat("overlapping lines contradict the prediction: that of ", part, " is too ",
                      factor.value > 1 ? "small" : "large", reason);
}

Json CrossCheckJson(const CrossCheck& check) {
  Json json = {{"conclusion", Conclusion(check)},
               {"agrees", nullptr},
               {"pairs", check.pairs},
               {"outliers", check.outliers},
               {"chi_square", check.chi_square},
               {"chi_square_within_lines", check.chi_square_within_lines},
               {"beyond_three_sigma", check.beyond_three_sigma},
               {"median_factor", check.median_factor},
               {"factor", EstimateJson(check.factor)},
               {"factor_pulse", EstimateJson(check.pulse.factor)},
               {"factor_air", EstimateJson(check.pulse.air)},
               {"factor_sea", EstimateJson(check.pulse.sea)},
               {"factor_line", nullptr},
               {"pulse_differs", check.pulse.differs},
               {"line_differs", check.line.differs},
               {"intervals_by", "places"},
               {"places", check.pulse.places},
               {"line_degrees_of_freedom", check.line.degrees},
               {"line_lasting", check.line.lasting},
               {"noise_of_means", check.line.noise},
               {"sea_known", check.sea_known},
               {"air_in_variance", check.air_in_variance},
               {"line_in_variance", check.line_in_variance},
               {"roughness", std::sqrt(check.pulse.rough)},
               {"guilty_share", nullptr},
               {"by_depth", BandsJson(check.by_depth)},
               {"by_incidence", BandsJson(check.by_incidence)},
               {"by_share_of_sea", BandsJson(check.by_sea_share)},
               {"lines", LinesJson(check.line.differences)}};
  if (const std::optional<bool> agrees = Agrees(check); agrees.has_value()) json["agrees"] = *agrees;
  if (check.line.factor.has_value()) json["factor_line"] = EstimateJson(*check.line.factor);
  if (!check.guilty.empty()) json["guilty_share"] = check.guilty;
  if (!check.left_out.empty()) json["left_out"] = LeftOutJson(check.left_out);
  return json;
}

std::string CrossCheckText(const CrossCheck& check) {
  std::string text = Conclusion(check) + "\n";
  absl::StrAppendFormat(
      &text,
      "%d pairs of neighbouring points of different lines, %d outliers left out\n"
      "reduced chi-square                   %.2f; without the mean difference of each two lines %.2f\n"
      "predicted sigma would have to be multiplied by\n"
      "  of pulses, %3.0f %% of the variance    %s\n"
      "    of the sensor                    %s\n"
      "    of the sea surface               %s\n",
      check.pairs, check.outliers, check.chi_square, check.chi_square_within_lines, 100 * (1 - check.line_in_variance),
      EstimateText(check.pulse.factor), EstimateText(check.pulse.air), EstimateText(check.pulse.sea));
  if (check.line.factor.has_value()) {
    absl::StrAppendFormat(&text, "  of lines, %3.0f %%                     %s, by %.1f degrees of freedom\n",
                          100 * check.line_in_variance, EstimateText(*check.line.factor), check.line.degrees);
  } else {
    absl::StrAppend(&text, "  of lines                           not tested: no trajectory error is predicted\n");
  }
  if (!check.sea_known) absl::StrAppend(&text, "the sea is not known: waves are taken as independent\n");
  absl::StrAppend(&text,
                  "not tested, because all lines share it: lever arm, boresight, clock, index, water level, datum\n");
  if (!check.left_out.empty()) absl::StrAppend(&text, LeftOutText(check.left_out), "\n");
  constexpr std::size_t kShown = 5;
  for (std::size_t i = 0; i < std::min(kShown, check.line.differences.size()); ++i)
    absl::StrAppend(&text, DifferenceText(check.line.differences[i]));
  return text;
}

}  // namespace albtpu::quality
