#include "service/client/pulse_text.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "service/client/number_text.h"
#include "tables/s44.h"

namespace albtpu::client {
namespace {

using Json = nlohmann::ordered_json;

std::optional<float> Coordinate(const Pulse& pulse, AxisId axis) {
  switch (axis) {
    case AxisId::kWindSpeed:
      return pulse.wind_speed;
    case AxisId::kFetch:
      return pulse.fetch;
    case AxisId::kIncidence:
      return pulse.incidence;
    case AxisId::kAzimuth:
      return pulse.azimuth;
    case AxisId::kFootprint:
      return pulse.footprint;
    case AxisId::kDepth:
      return pulse.depth;
  }
  return std::nullopt;
}

// The number that JSON prints with the digits of FormatFloat.
Json JsonNumber(float value) {
  if (!std::isfinite(value)) return nullptr;
  return *ParseDouble(FormatFloat(value));
}

Json JsonValue(const AnswerCell& cell) {
  if (const float* number = std::get_if<float>(&cell)) return JsonNumber(*number);
  if (const std::string* text = std::get_if<std::string>(&cell)) return *text;
  return nullptr;
}

std::string CoordinateText(const Pulse& pulse, AxisId axis) {
  const std::optional<float> value = Coordinate(pulse, axis);
  if (!value.has_value()) return "not given: each value is the larger of those along and across the wind";
  if (axis == AxisId::kFetch && std::isinf(*value)) return "fully developed sea";
  return absl::StrCat(FormatFloat(*value), " ", std::string(Describe(axis).units));
}

std::string Line(std::string_view label, std::string_view text) {
  return absl::StrFormat("%-24s %s\n", std::string(label), std::string(text));
}

std::string ValueText(Quantity quantity, const PulseUncertainty& stated, const AnswerStyle& style) {
  const float value = stated[quantity];
  if (!std::isfinite(value)) return "not in this table";
  const float error = stated.standard_errors[Index(quantity)];
  std::string text = absl::StrFormat("%.6g", value);
  if (style.standard_errors) {
    absl::StrAppend(
        &text, std::isfinite(error) ? absl::StrFormat(" +- %.2g", error) : " (standard error not known)");
  }
  absl::StrAppend(&text, " ", std::string(Describe(quantity).units));
  if (Describe(quantity).is_bias) return text + ", mean";
  return text + (style.coverage == Coverage::kTwoSigma ? ", 2 sigma" : ", 95 %");
}

std::string Room(double limit, double ours) {
  const std::optional<double> left = RemainingBudget(limit, ours);
  return left.has_value() ? absl::StrFormat("%.3f m", *left) : "exceeded";
}

std::string S44Text(const Pulse& pulse, const PulseUncertainty& two_sigma, const AnswerStyle& style) {
  const PulseUncertainty p95 = WithCoverage(two_sigma, Coverage::kP95);
  const double thu = p95[Quantity::kThu], tvu = p95[Quantity::kTvu], depth = pulse.depth;
  const std::optional<S44Order> best = BestOrder(thu, tvu, depth);
  std::string text = absl::StrFormat("\n%s, all at 95 %%: the sea surface alone has THU %.6g m, TVU %.6g m\n",
                                     std::string(kS44Edition), thu, tvu);
  absl::StrAppend(&text, "best order left open: ", best.has_value() ? std::string(Name(*best)) : "none", "\n",
                  absl::StrFormat("%-12s %12s %12s %26s\n", "order", "THU limit", "TVU limit",
                                  "left for all else: THU, TVU"));
  for (const S44Order order : kS44Orders) {
    if (style.s44_order.has_value() && order != *style.s44_order) continue;
    const double thu_limit = ThuLimit(order, depth), tvu_limit = TvuLimit(order, depth);
    absl::StrAppend(&text, absl::StrFormat("%-12s %10.3f m %10.3f m %13s %13s\n", std::string(Name(order)),
                                           thu_limit, tvu_limit, Room(thu_limit, thu), Room(tvu_limit, tvu)));
  }
  return text;
}

std::string WhyNoNumber(const PulseUncertainty& answer, const TableSummary& table) {
  if (!answer.axis.has_value()) return "no number";
  const AxisSchema& axis = Describe(*answer.axis);
  const AxisRange& range = table.axes[Index(*answer.axis)];
  return absl::StrFormat("no number is invented: the table reaches %s from %g to %g %s",
                         std::string(axis.name), range.first, range.last, std::string(axis.units));
}

}  // namespace

std::string PulseText(const Pulse& pulse, const PulseUncertainty& two_sigma, AnswerStyle style,
                      const TableSummary& table) {
  std::string text = Line("table", absl::StrCat(table.id, " ", table.version, ": ", table.title)) +
                     Line("digest", table.digest);
  for (const AxisId axis : kAxes) text += Line(Describe(axis).name, CoordinateText(pulse, axis));
  text += Line("outcome", OutcomeText(two_sigma));
  if (two_sigma.outcome != Outcome::kInterpolated) return text + WhyNoNumber(two_sigma, table) + "\n";
  const PulseUncertainty stated = WithCoverage(two_sigma, style.coverage);
  for (const Quantity quantity : kQuantities) {
    text += Line(Describe(quantity).name, ValueText(quantity, stated, style));
  }
  return text + S44Text(pulse, two_sigma, style);
}

std::string PulseJson(const Pulse& pulse, const PulseUncertainty& two_sigma, AnswerStyle style,
                      const TableSummary& table) {
  Json object;
  for (const AxisId axis : kAxes) {
    const std::optional<float> value = Coordinate(pulse, axis);
    object[std::string(Describe(axis).name)] = value.has_value() ? JsonNumber(*value) : Json(nullptr);
  }
  const AnswerColumns columns(style);
  const std::vector<AnswerCell> cells = columns.Cells(pulse, two_sigma);
  for (std::size_t i = 0; i < cells.size(); ++i) object[columns.names()[i]] = JsonValue(cells[i]);
  object["azimuth_absent"] = !pulse.azimuth.has_value();
  object["table"] = table.id;
  object["version"] = table.version;
  object["digest"] = table.digest;
  object["coverage"] = style.coverage == Coverage::kTwoSigma ? "2sigma" : "p95";
  return object.dump(2) + "\n";
}

}  // namespace albtpu::client
