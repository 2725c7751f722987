#include "annotate/answers/answer_tally.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace albtpu::annotate {
namespace {

using Json = nlohmann::ordered_json;

// Null if there is none.
const Json& Member(const Json& object, const std::string& name) {
  static const Json null;
  const auto found = object.is_object() ? object.find(name) : object.end();
  return found == object.end() ? null : *found;
}

std::uint64_t Count(const Json& json) { return json.is_number_unsigned() ? json.get<std::uint64_t>() : 0; }

std::optional<double> Number(const Json& json) {
  return json.is_number() ? std::optional(json.get<double>()) : std::nullopt;
}

std::optional<AnswerTally::Spread> ReadSpread(const Json& json) {
  const std::optional<double> least = Number(Member(json, "least")), median = Number(Member(json, "median")),
                              greatest = Number(Member(json, "greatest"));
  if (!least.has_value() || !median.has_value() || !greatest.has_value()) return std::nullopt;
  return AnswerTally::Spread{.least = *least, .median = *median, .greatest = *greatest};
}

}  // namespace

AnswerTally AnswerTally::FromJson(const Json& answers) {
  AnswerTally tally;
  const Json& outcomes = Member(answers, "outcomes");
  if (!outcomes.is_object()) return tally;
  for (const auto& [outcome, number] : outcomes.items()) {
    const std::uint64_t count = Count(number);
    tally.chosen += count;
    if (outcome == "INTERPOLATED") {
      tally.interpolated = count;
    } else if (count > 0) {
      tally.without_number[outcome] = {count, ReadSpread(Member(Member(answers, "outside"), outcome))};
    }
  }
  tally.min_depth = Number(Member(Member(answers, "depth"), "least"));
  return tally;
}

void AnswerTally::Merge(const AnswerTally& other) {
  chosen += other.chosen;
  interpolated += other.interpolated;
  if (other.min_depth.has_value()) {
    min_depth = std::min(min_depth.value_or(*other.min_depth), *other.min_depth);
  }
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

}  // namespace albtpu::annotate
