#include "annotate/answers/uncertainty_summary.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_split.h"
#include "formats/text/text.h"

namespace albtpu::annotate {
namespace {

// A bin has the numbers of one sign and exponent whose first three bits of the mantissa are the same: its width is at
// most 1/8 of a number in it, and so its middle within 1/16.
constexpr int kDroppedBits = 20;
constexpr std::size_t kBins = std::size_t{1} << (32 - kDroppedBits);
constexpr std::uint32_t kSignBit = 1u << 31;

// Bits that increase with the number: IEEE 754 stores sign and magnitude.
std::uint32_t OrderedBits(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return (bits & kSignBit) != 0 ? ~bits : bits | kSignBit;
}

float FromOrderedBits(std::uint32_t bits) {
  return std::bit_cast<float>((bits & kSignBit) != 0 ? bits & ~kSignBit : ~bits);
}

}  // namespace

void CoordinateSpread::Add(float value) {
  if (bins_.empty()) bins_.resize(kBins);
  ++count_;
  ++bins_[OrderedBits(value) >> kDroppedBits];
  least_ = std::min(least_, value);
  greatest_ = std::max(greatest_, value);
}

void CoordinateSpread::Merge(const CoordinateSpread& other) {
  if (other.count_ == 0) return;
  if (bins_.empty()) bins_.resize(kBins);
  count_ += other.count_;
  for (std::size_t i = 0; i < kBins; ++i) bins_[i] += other.bins_[i];
  least_ = std::min(least_, other.least_);
  greatest_ = std::max(greatest_, other.greatest_);
}

float CoordinateSpread::middle() const {
  std::uint64_t below = 0;
  std::size_t bin = 0;
  while (2 * (below + bins_[bin]) < count_) below += bins_[bin++];
  const std::uint32_t center = (static_cast<std::uint32_t>(bin) << kDroppedBits) | (1u << (kDroppedBits - 1));
  return std::clamp(FromOrderedBits(center), least_, greatest_);
}

std::size_t BandOf(float depth) {
  std::size_t band = 0;  // Counting the ends below the depth needs no branches.
  for (const float end : kBandEnds) band += depth >= end;
  return band;
}

double BandBegin(std::size_t band) { return band == 0 ? 0 : kBandEnds[band - 1]; }

std::string BandText(std::size_t band) {
  const std::string end = band < kBandEnds.size() ? absl::StrFormat("%g", kBandEnds[band]) : "";
  return absl::StrFormat("%g - %s", BandBegin(band), end);
}

nlohmann::ordered_json BandJson(std::size_t band) {
  nlohmann::ordered_json json = {{"from", band == 0 ? 0 : kBandEnds[band - 1]}, {"to", nullptr}};
  if (band < kBandEnds.size()) json["to"] = kBandEnds[band];
  return json;
}

namespace {

// Of an attribute: rms, 99th percentile, maximum, noise, number of pulses. nullopt if no pulse was compared, or if a
// server sends something else.
std::optional<InterpolationError> Parse(Quantity quantity, const std::string& attribute) {
  std::vector<double> numbers;
  for (const absl::string_view text : absl::StrSplit(attribute, ", ")) {
    double number = 0;
    if (!absl::SimpleAtod(text, &number) || !std::isfinite(number)) return std::nullopt;
    numbers.push_back(number);
  }
  if (numbers.size() != 5 || numbers[4] <= 0) return std::nullopt;
  return InterpolationError{quantity, numbers[0], numbers[1]};
}

}  // namespace

std::vector<InterpolationError> InterpolationErrors(const client::TableSummary& table) {
  std::vector<InterpolationError> errors;
  for (const Quantity quantity : kQuantities) {
    const auto attribute = table.attributes.find("interpolation_error_" + std::string(Describe(quantity).name));
    if (attribute == table.attributes.end()) continue;
    const std::optional<InterpolationError> error = Parse(quantity, attribute->second);
    if (error.has_value()) errors.push_back(*error);
  }
  return errors;
}

std::string Text(const InterpolationError& error) {
  return absl::StrCat(formats::PercentText(error.rms), " rms, ", formats::PercentText(error.percentile_99),
                      " at the 99th percentile");
}

std::string InterpolationErrorNote(const client::TableSummary& table) {
  const std::vector<InterpolationError> errors = InterpolationErrors(table);
  if (errors.empty()) return "interpolation error: not known (the table does not state it)";
  std::string note = "interpolation error, relative, at random pulses all over the table: ";
  for (std::size_t i = 0; i < errors.size(); ++i)
    absl::StrAppend(&note, i > 0 ? "; " : "", std::string(Describe(errors[i].quantity).name), " ", Text(errors[i]));
  return note;
}

namespace {

using nlohmann::ordered_json;

double Mean(double sum, std::uint64_t count) { return sum / static_cast<double>(count); }

}  // namespace

void UncertaintySummary::Select(AnswerSelection& selection) {
  selection.quantities[Index(Quantity::kThu)] = selection.quantities[Index(Quantity::kTvu)] = true;
  selection.best_s44_orders = true;
}

void UncertaintySummary::Range::Add(float value, float standard_error) {
  sum += value;
  standard_error_sum += standard_error;
  least = std::min(least, value);
  greatest = std::max(greatest, value);
}

void UncertaintySummary::Range::Merge(const Range& other) {
  sum += other.sum;
  standard_error_sum += other.standard_error_sum;
  least = std::min(least, other.least);
  greatest = std::max(greatest, other.greatest);
}

ordered_json UncertaintySummary::Range::Json(std::uint64_t count, bool standard_errors) const {
  ordered_json json = {
      {"least", formats::JsonNumber(least)}, {"mean", Mean(sum, count)}, {"greatest", formats::JsonNumber(greatest)}};
  // Null where the table has no standard errors.
  if (standard_errors) json["mean_standard_error"] = Mean(standard_error_sum, count);
  return json;
}

std::uint64_t UncertaintySummary::Band::Within(S44Order order) const {
  // A pulse that leaves a stricter order open leaves this one open, too: its limits are wider.
  std::uint64_t within = 0;
  for (std::size_t i = 1; i <= static_cast<std::size_t>(order) + 1; ++i) within += best_orders[i];
  return within;
}

void UncertaintySummary::Band::Merge(const Band& other) {
  count += other.count;
  for (std::size_t i = 0; i < best_orders.size(); ++i) best_orders[i] += other.best_orders[i];
  thu.Merge(other.thu);
  tvu.Merge(other.tvu);
}

void UncertaintySummary::Add(const PulseBatch& pulses, const AnswerBatch& answers) {
  outcomes_.Add(answers, pulses.axis[Index(AxisId::kAzimuth)].empty());
  const std::vector<float>& depths = pulses.axis[Index(AxisId::kDepth)];
  const auto error = [&](Quantity quantity, std::size_t i) {
    return style_.standard_errors ? answers.standard_errors[Index(quantity)][i] : 0;
  };
  for (std::size_t i = 0; i < pulses.size; ++i) {
    if (!answers.interpolated(i)) {
      if (answers.sides[i] == 0) continue;  // Invalid, or without an axis to name.
      const AxisId axis = kAxes[answers.outcome_axes[i] - 1];
      outside_[OutcomeCounts::Number(answers, i)].Add(pulses.coordinate(axis, i));
      continue;
    }
    const float depth = depths[depths.size() == 1 ? 0 : i];
    min_depth_ = std::min(min_depth_, depth);
    max_depth_ = std::max(max_depth_, depth);
    Band& band = bands_[BandOf(depth)];
    ++band.count;
    ++band.best_orders[answers.best_s44_orders[i]];
    band.thu.Add(answers[Quantity::kThu][i], error(Quantity::kThu, i));
    band.tvu.Add(answers[Quantity::kTvu][i], error(Quantity::kTvu, i));
  }
}

void UncertaintySummary::AddAboveWater(float depth, NoPulse why) {
  outcomes_.Add(why);
  above_water_.Add(depth);
}

void UncertaintySummary::Merge(const UncertaintySummary& other) {
  outcomes_.Merge(other.outcomes_);
  for (std::size_t i = 0; i < outside_.size(); ++i) outside_[i].Merge(other.outside_[i]);
  above_water_.Merge(other.above_water_);
  for (std::size_t i = 0; i < bands_.size(); ++i) bands_[i].Merge(other.bands_[i]);
  min_depth_ = std::min(min_depth_, other.min_depth_);
  max_depth_ = std::max(max_depth_, other.max_depth_);
}

AnswerTally UncertaintySummary::Tally() const {
  AnswerTally tally;
  tally.chosen = outcomes_.total();
  tally.interpolated = outcomes_.interpolated();
  const auto add = [&tally](std::string_view outcome, std::uint64_t count, const CoordinateSpread& spread) {
    if (count == 0) return;
    AnswerTally::WithoutNumber& without_number = tally.without_number[std::string(outcome)];
    without_number.count = count;
    if (spread.count() > 0) without_number.coordinate = {spread.least(), spread.middle(), spread.greatest()};
  };
  for (std::size_t i = 1; i < outside_.size(); ++i) add(OutcomeCounts::Name(i), outcomes_.count(i), outside_[i]);
  for (std::size_t i = 0; i < kNoPulseCount; ++i) {
    const auto why = static_cast<NoPulse>(i);
    add(OutcomeName(why), outcomes_.count(why), IsAbove(why) ? above_water_ : CoordinateSpread());
  }
  if (std::isfinite(min_depth_)) tally.min_depth = min_depth_;
  return tally;
}

std::string UncertaintySummary::TextOf(std::size_t index) const {
  const Band& band = bands_[index];
  const double begin = BandBegin(index);
  std::string text =
      absl::StrFormat("  %11s %9d %8.3f %8.3f %8.3f %8.3f %8.3f %8.3f %7.1f %%", BandText(index), band.count,
                      Mean(band.thu.sum, band.count), band.thu.greatest, Mean(band.tvu.sum, band.count),
                      band.tvu.greatest, ThuLimit(order(), begin), TvuLimit(order(), begin),
                      100 * Mean(static_cast<double>(band.Within(order())), band.count));
  if (style_.standard_errors) {
    absl::StrAppend(&text, absl::StrFormat(" %9.2g %9.2g", Mean(band.thu.standard_error_sum, band.count),
                                           Mean(band.tvu.standard_error_sum, band.count)));
  }
  return text;
}

std::string UncertaintySummary::Text(std::string_view without_azimuth) const {
  std::string text = outcomes_.Text(without_azimuth);
  if (outcomes_.interpolated() == 0) return text;
  absl::StrAppend(&text,
                  absl::StrFormat("\n  depth %.3f m to %.3f m; sea surface only; limits are those at the shallow end",
                                  min_depth_, max_depth_));
  const std::string coverage = CoverageText(style_.coverage);
  const std::string order_name = std::string(Name(order()));
  absl::StrAppend(&text, absl::StrFormat("\n  %11s %9s %17s %17s %27s", "depth", "points", "THU, " + coverage,
                                         "TVU, " + coverage, "S-44 " + order_name + " limits, 95 %"));
  absl::StrAppend(&text, absl::StrFormat("\n  %11s %9s %8s %8s %8s %8s %8s %8s %9s%s", "m", "", "mean m", "max m",
                                         "mean m", "max m", "THU m", "TVU m", "within",
                                         style_.standard_errors ? "  s.e. THU  s.e. TVU" : ""));
  for (std::size_t i = 0; i < bands_.size(); ++i)
    if (bands_[i].count > 0) absl::StrAppend(&text, "\n", TextOf(i));
  return text;
}

ordered_json UncertaintySummary::JsonOf(std::size_t index) const {
  const Band& band = bands_[index];
  ordered_json json = BandJson(index);
  json["pulses"] = band.count;
  json["thu"] = band.thu.Json(band.count, style_.standard_errors);
  json["tvu"] = band.tvu.Json(band.count, style_.standard_errors);
  for (const S44Order order : kS44Orders) json["s44_left_open"][std::string(Name(order))] = band.Within(order);
  return json;
}

ordered_json UncertaintySummary::OutsideJson() const {
  ordered_json json = ordered_json::object();
  const auto add = [&json](std::string_view outcome, const CoordinateSpread& spread) {
    if (spread.count() == 0) return;
    json[std::string(outcome)] = {{"least", formats::JsonNumber(spread.least())},
                                  {"median", formats::JsonNumber(spread.middle())},
                                  {"greatest", formats::JsonNumber(spread.greatest())}};
  };
  for (std::size_t i = 0; i < outside_.size(); ++i) add(OutcomeCounts::Name(i), outside_[i]);
  add(OutcomeName(NoPulse::kAboveWater), above_water_);
  return json;
}

ordered_json UncertaintySummary::Json() const {
  Band all;
  ordered_json bands = ordered_json::array();
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    all.Merge(bands_[i]);
    if (bands_[i].count > 0) bands.push_back(JsonOf(i));
  }
  ordered_json json;
  json["pulses"] = outcomes_.total();
  json["outcomes"] = outcomes_.Json();
  json["without_azimuth"] = outcomes_.without_azimuth();
  if (ordered_json outside = OutsideJson(); !outside.empty()) json["outside"] = std::move(outside);
  if (all.count == 0) return json;
  json["depth"] = {{"least", formats::JsonNumber(min_depth_)}, {"greatest", formats::JsonNumber(max_depth_)}};
  ordered_json& orders = json["s44_best_order"];
  for (const S44Order order : kS44Orders)
    orders[std::string(Name(order))] = all.best_orders[static_cast<std::size_t>(order) + 1];
  orders["none"] = all.best_orders[0];
  json["depth_bands"] = std::move(bands);
  return json;
}

}  // namespace albtpu::annotate
