// The outcomes of the answers of a file or of a run: their names, their counts, and the cells of an answer in CSV and
// JSON.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "annotate/answers/batch.h"

namespace albtpu::annotate {

// The outcomes of a file or of a whole run. Outputs of an earlier run count, too, by their summaries.
struct AnswerTally {
  // The coordinate that caused an outcome, in the unit of its axis.
  struct Spread {
    double least = 0, median = 0, greatest = 0;
  };
  struct WithoutNumber {
    std::uint64_t count = 0;
    std::optional<Spread> coordinate;  // None where no coordinate caused the outcome.
  };

  std::uint64_t chosen = 0, interpolated = 0;
  std::map<std::string, WithoutNumber> without_number;  // By outcome, as summaries name it.
  std::optional<double> min_depth;                      // m, of interpolated pulses.

  // From the answers in a summary file. Any JSON gives a tally; missing members count as 0.
  static AnswerTally FromJson(const nlohmann::ordered_json& answers);

  // The median becomes that of the tally with more of the outcome.
  void Merge(const AnswerTally& other);

  bool mostly_without_number() const { return 2 * interpolated < chosen; }
};

// The number of pulses with each outcome.

// Why a chosen point has no pulse with which a table could be queried.
enum class NoPulse : std::uint8_t {
  kNoTrajectory,         // No position of the sensor is known at its time.
  kUncertainTrajectory,  // The position is too uncertain for an incidence.
  kNoSurface,            // No water surface is known there.
  kNoSea,                // The series of the sea has no state at its time.
  kAboveWater,           // The point lies above the water surface.
  kDry,                  // The same, and it has the uncertainty of a dry point.
  kNoChannel,            // It belongs to none of the scanners that the survey has.
};
inline constexpr std::size_t kNoPulseCount = 7;

constexpr bool IsAbove(NoPulse why) { return why == NoPulse::kAboveWater || why == NoPulse::kDry; }

std::string_view OutcomeName(NoPulse why);  // "NO_TRAJECTORY" and its like.

// "INTERPOLATED", "OUT_OF_DOMAIN:depth:above", "INVALID" or "NO_WATER", as CSV files and messages state it.
std::string_view OutcomeName(const AnswerBatch& answers, std::size_t i);

// The meaning of an answer without azimuth, by a table of winds and by a table of one sea.
inline constexpr std::string_view kWorseOfTheWind = "each value is the larger of those along and across the wind";
inline constexpr std::string_view kWorstOfTheSea = "each value is the largest of all azimuths";
inline std::string_view WithoutAzimuth(const client::TableSummary& table) {
  return table.sea.has_value() ? kWorstOfTheSea : kWorseOfTheWind;
}

class OutcomeCounts {
 public:
  // Pulses that were queried. `azimuth_absent` means that none of them had an azimuth.
  void Add(const AnswerBatch& answers, bool azimuth_absent);
  // Chosen points without a query.
  void Add(NoPulse why, std::uint64_t count = 1) { without_pulse_[static_cast<std::size_t>(why)] += count; }
  void Merge(const OutcomeCounts& other);

  std::uint64_t total() const;  // All chosen points, queried or not.
  std::uint64_t interpolated() const { return asked_[0]; }
  std::uint64_t count(std::size_t number) const { return asked_[number]; }  // By Number().
  std::uint64_t count(NoPulse why) const { return without_pulse_[static_cast<std::size_t>(why)]; }

  // "56382 pulses: 56000 interpolated, 382 OUT_OF_DOMAIN:depth:above", and the number without azimuth, if any, with
  // what the answers to these are.
  std::string Text(std::string_view without_azimuth = kWorseOfTheWind) const;

  // {"INTERPOLATED": 56000, "OUT_OF_DOMAIN:depth:above": 382}; other outcomes appear only if they occurred, those of
  // the table first, by axis.
  nlohmann::ordered_json Json() const;
  std::uint64_t without_azimuth() const { return without_azimuth_; }

  // Outcomes of queried pulses, numbered in the order of Json(): interpolated, out of domain by axis and side, invalid,
  // without a contribution of the water column.
  static constexpr std::size_t kOutOfDomainCount = (kAxisCount + 1) * 3;  // No axis, no side.
  static constexpr std::size_t kAskedCount = kOutOfDomainCount + 3;
  static std::size_t Number(const AnswerBatch& answers, std::size_t i) {
    const std::uint8_t outcome = answers.outcomes[i];
    if (outcome == 1) return 0;
    if (outcome == 2) return 1 + 3 * std::size_t{answers.outcome_axes[i]} + answers.sides[i];
    return outcome == kNoWater ? kAskedCount - 1 : kAskedCount - 2;
  }
  static std::string_view Name(std::size_t number);

 private:
  std::uint64_t AskedTotal() const;

  std::array<std::uint64_t, kAskedCount> asked_ = {};
  std::array<std::uint64_t, kNoPulseCount> without_pulse_ = {};
  std::uint64_t without_azimuth_ = 0;
};

// The cells of an answer: which columns there are, their order and their contents. CSV files and `pulse --json`
// share them.

// Columns, in order:
//   refraction_along_wind, refraction_cross_wind  degree
//   thu, tvu, bias_along_beam, bias_vertical      m
//   outcome                                       "INTERPOLATED", "OUT_OF_DOMAIN:depth:above", "INVALID"
//   with standard errors:  <each of the six>_standard_error, in the same unit
//   with an S-44 order:
//     s44_best_order                              the strictest order that the sea surface alone leaves open;
//                                                 empty if there is none
//     s44_remaining_thu, s44_remaining_tvu        m at 95 %: what the order's limit leaves for all other error
//                                                 sources; empty if the sea surface alone exceeds it
class AnswerCells {
 public:
  explicit AnswerCells(AnswerStyle style);

  const std::vector<std::string>& names() const { return names_; }
  AnswerSelection selection() const;

  // Calls `number(float)`, `text(std::string_view)` or `nothing()` for each column in order.
  template <typename NumberCell, typename TextCell, typename EmptyCell>
  void Visit(const AnswerBatch& answers, std::size_t i, NumberCell number, TextCell text, EmptyCell nothing) const {
    const auto number_or_nothing = [&](float value) { std::isfinite(value) ? number(value) : nothing(); };
    for (const auto& column : answers.values) number_or_nothing(column[i]);
    text(OutcomeName(answers, i));
    if (style_.standard_errors)
      for (const auto& column : answers.standard_errors) number_or_nothing(column[i]);
    if (!style_.s44_order.has_value()) return;
    const std::uint8_t best = answers.best_s44_orders[i];
    best > 0 ? text(Name(kS44Orders[best - 1])) : nothing();
    number_or_nothing(answers.remaining_thu[i]);
    number_or_nothing(answers.remaining_tvu[i]);
  }

 private:
  AnswerStyle style_;
  std::vector<std::string> names_;
};

}  // namespace albtpu::annotate
