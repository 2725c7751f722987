#include "survey/answers/outcome_counts.h"

#include <nlohmann/json.hpp>
#include <numeric>

#include "absl/strings/str_cat.h"

namespace albtpu::client {
namespace {

// "OUT_OF_DOMAIN:depth" and its like, by axis.
std::array<std::string, kAxisCount> OutOfDomainNames() {
  std::array<std::string, kAxisCount> names;
  for (const AxisId axis : kAxes) {
    names[Index(axis)] = absl::StrCat("OUT_OF_DOMAIN:", std::string(Describe(axis).name));
  }
  return names;
}

}  // namespace

std::string_view OutcomeName(std::uint8_t outcome, std::uint8_t axis) {
  static const std::array<std::string, kAxisCount> out_of_domain = OutOfDomainNames();
  if (outcome == 1) return "INTERPOLATED";
  if (outcome == 2) return axis > 0 ? std::string_view(out_of_domain[axis - 1]) : "OUT_OF_DOMAIN";
  return "INVALID";
}

void OutcomeCounts::Add(const AnswerBatch& answers, bool azimuth_absent) {
  for (std::size_t i = 0; i < answers.outcomes.size(); ++i) {
    ++counts_[answers.outcomes[i] - 1][answers.outcome_axes[i]];
  }
  if (azimuth_absent) without_azimuth_ += answers.outcomes.size();
}

void OutcomeCounts::Merge(const OutcomeCounts& other) {
  for (std::size_t outcome = 0; outcome < kOutcomes; ++outcome) {
    for (std::size_t axis = 0; axis < kAxesAndNone; ++axis) {
      counts_[outcome][axis] += other.counts_[outcome][axis];
    }
  }
  without_azimuth_ += other.without_azimuth_;
}

std::uint64_t OutcomeCounts::ByOutcome(std::size_t outcome) const {
  return std::accumulate(counts_[outcome].begin(), counts_[outcome].end(), std::uint64_t{0});
}

std::uint64_t OutcomeCounts::total() const { return ByOutcome(0) + ByOutcome(1) + ByOutcome(2); }

nlohmann::ordered_json OutcomeCounts::Json() const {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  json["INTERPOLATED"] = interpolated();
  for (std::size_t axis = 0; axis < kAxesAndNone; ++axis) {
    if (counts_[1][axis] > 0) json[std::string(OutcomeName(2, axis))] = counts_[1][axis];
  }
  if (ByOutcome(2) > 0) json["INVALID"] = ByOutcome(2);
  return json;
}

std::string OutcomeCounts::Text() const {
  std::string text =
      absl::StrCat(total(), total() == 1 ? " pulse: " : " pulses: ", interpolated(), " interpolated");
  const nlohmann::ordered_json json = Json();
  for (const auto& [outcome, count] : json.items()) {
    if (outcome != "INTERPOLATED") absl::StrAppend(&text, ", ", count.get<std::uint64_t>(), " ", outcome);
  }
  if (without_azimuth_ > 0) {
    absl::StrAppend(&text, "; ", without_azimuth_ == total() ? "all" : absl::StrCat(without_azimuth_),
                    " without azimuth: each value is the larger of those along and across the wind");
  }
  return text;
}

}  // namespace albtpu::client
