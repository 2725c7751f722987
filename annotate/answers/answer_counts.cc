#include "annotate/answers/answer_counts.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string_view>

#include "absl/strings/str_cat.h"
#include "tables/pulse.h"

namespace albtpu::annotate {
namespace {

using nlohmann::ordered_json;

// Null if there is none.
const ordered_json& Member(const ordered_json& object, std::string_view name) {
  static const ordered_json null;
  const auto found = object.is_object() ? object.find(name) : object.end();
  return found == object.end() ? null : *found;
}

std::uint64_t Count(const ordered_json& json) { return json.is_number_unsigned() ? json.get<std::uint64_t>() : 0; }

std::optional<double> Number(const ordered_json& json) {
  return json.is_number() ? std::optional(json.get<double>()) : std::nullopt;
}

std::optional<AnswerTally::Spread> ReadSpread(const ordered_json& json) {
  const std::optional<double> least = Number(Member(json, "least")), median = Number(Member(json, "median")),
                              greatest = Number(Member(json, "greatest"));
  if (!least.has_value() || !median.has_value() || !greatest.has_value()) return std::nullopt;
  return AnswerTally::Spread{.least = *least, .median = *median, .greatest = *greatest};
}

}  // namespace

AnswerTally AnswerTally::FromJson(const ordered_json& answers) {
  AnswerTally tally;
  const ordered_json& outcomes = Member(answers, "outcomes");
  if (!outcomes.is_object()) return tally;
  for (const auto& [outcome, number] : outcomes.items()) {
    const std::uint64_t count = Count(number);
    tally.chosen += count;
    if (outcome == "INTERPOLATED")
      tally.interpolated = count;
    else if (count > 0)
      tally.without_number[outcome] = {count, ReadSpread(Member(Member(answers, "outside"), outcome))};
  }
  tally.min_depth = Number(Member(Member(answers, "depth"), "least"));
  return tally;
}

void AnswerTally::Merge(const AnswerTally& other) {
  chosen += other.chosen;
  interpolated += other.interpolated;
  if (other.min_depth.has_value()) min_depth = std::min(min_depth.value_or(*other.min_depth), *other.min_depth);
  for (const auto& [outcome, theirs] : other.without_number) {
    WithoutNumber& ours = without_number[outcome];
    if (ours.coordinate.has_value() && theirs.coordinate.has_value()) {
      Spread& spread = *ours.coordinate;
      if (theirs.count > ours.count) spread.median = theirs.coordinate->median;
      spread.least = std::min(spread.least, theirs.coordinate->least);
      spread.greatest = std::max(spread.greatest, theirs.coordinate->greatest);
    } else if (theirs.coordinate.has_value()) {
      ours.coordinate = theirs.coordinate;
    }
    ours.count += theirs.count;
  }
}

namespace {

using Names = std::array<std::string, OutcomeCounts::kAskedCount>;

Names MakeNames() {
  Names names;
  names.front() = "INTERPOLATED";
  names[OutcomeCounts::kAskedCount - 2] = "INVALID";
  names.back() = "NO_WATER";
  const std::string sides[] = {"", absl::StrCat(":", std::string(albtpu::Name(Side::kBelow))),
                               absl::StrCat(":", std::string(albtpu::Name(Side::kAbove)))};
  for (std::size_t i = 0; i < OutcomeCounts::kOutOfDomainCount; ++i) {
    const std::size_t axis = i / 3;
    names[1 + i] = absl::StrCat(
        "OUT_OF_DOMAIN", axis > 0 ? absl::StrCat(":", std::string(Describe(kAxes[axis - 1]).name)) : "", sides[i % 3]);
  }
  return names;
}

}  // namespace

std::string_view OutcomeCounts::Name(std::size_t number) {
  static const Names names = MakeNames();
  return names[number];
}

std::string_view OutcomeName(NoPulse why) {
  constexpr std::array<std::string_view, kNoPulseCount> kNames = {
      "NO_TRAJECTORY", "UNCERTAIN_TRAJECTORY", "NO_SURFACE", "NO_SEA", "ABOVE_WATER", "DRY", "NO_CHANNEL"};
  return kNames[static_cast<std::size_t>(why)];
}

std::string_view OutcomeName(const AnswerBatch& answers, std::size_t i) {
  return OutcomeCounts::Name(OutcomeCounts::Number(answers, i));
}

void OutcomeCounts::Add(const AnswerBatch& answers, bool azimuth_absent) {
  for (std::size_t i = 0; i < answers.outcomes.size(); ++i) ++asked_[Number(answers, i)];
  if (azimuth_absent) without_azimuth_ += answers.outcomes.size();
}

void OutcomeCounts::Merge(const OutcomeCounts& other) {
  for (std::size_t i = 0; i < asked_.size(); ++i) asked_[i] += other.asked_[i];
  for (std::size_t i = 0; i < without_pulse_.size(); ++i) without_pulse_[i] += other.without_pulse_[i];
  without_azimuth_ += other.without_azimuth_;
}

std::uint64_t OutcomeCounts::AskedTotal() const {
  return std::accumulate(asked_.begin(), asked_.end(), std::uint64_t{0});
}

std::uint64_t OutcomeCounts::total() const {
  return std::accumulate(without_pulse_.begin(), without_pulse_.end(), AskedTotal());
}

nlohmann::ordered_json OutcomeCounts::Json() const {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  json["INTERPOLATED"] = interpolated();
  for (std::size_t i = 1; i < asked_.size(); ++i)
    if (asked_[i] > 0) json[std::string(Name(i))] = asked_[i];
  for (std::size_t i = 0; i < without_pulse_.size(); ++i)
    if (without_pulse_[i] > 0) json[std::string(OutcomeName(static_cast<NoPulse>(i)))] = without_pulse_[i];
  return json;
}

std::string OutcomeCounts::Text(std::string_view without_azimuth) const {
  std::string text = absl::StrCat(total(), total() == 1 ? " pulse: " : " pulses: ", interpolated(), " interpolated");
  const nlohmann::ordered_json json = Json();
  for (const auto& [outcome, count] : json.items())
    if (outcome != "INTERPOLATED") absl::StrAppend(&text, ", ", count.get<std::uint64_t>(), " ", outcome);
  if (without_azimuth_ > 0) {
    absl::StrAppend(&text, "; ", without_azimuth_ == AskedTotal() ? "all" : absl::StrCat(without_azimuth_),
                    " without azimuth: ", std::string(without_azimuth));
  }
  return text;
}

AnswerCells::AnswerCells(AnswerStyle style) : style_(style) {
  for (const Quantity quantity : kQuantities) names_.emplace_back(Describe(quantity).name);
  names_.emplace_back("outcome");
  if (style_.standard_errors)
    for (const Quantity quantity : kQuantities)
      names_.push_back(std::string(Describe(quantity).name) + std::string(kStandardErrorSuffix));
  if (style_.s44_order.has_value())
    names_.insert(names_.end(), {"s44_best_order", "s44_remaining_thu", "s44_remaining_tvu"});
}

AnswerSelection AnswerCells::selection() const {
  AnswerSelection selection;
  selection.quantities.fill(true);
  selection.standard_errors = style_.standard_errors;
  selection.best_s44_orders = selection.s44_remaining = style_.s44_order.has_value();
  return selection;
}

}  // namespace albtpu::annotate
