// The number of pulses with each outcome.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "annotate/answers/batch.h"

namespace albtpu::annotate {

// Why a chosen point has no pulse with which a table could be queried.
enum class NoPulse : std::uint8_t {
  kNoTrajectory,         // No position of the sensor is known at its time.
  kUncertainTrajectory,  // The position is too uncertain for an incidence.
  kNoSurface,            // No water surface is known there.
  kNoSea,                // The series of the sea has no state at its time.
  kAboveWater,           // The point lies above the water surface.
};
inline constexpr std::size_t kNoPulseCount = 5;

std::string_view OutcomeName(NoPulse why);  // "NO_TRAJECTORY" and its like.

// "INTERPOLATED", "OUT_OF_DOMAIN:depth:above", "INVALID" or "NO_WATER", as CSV files and messages state it.
std::string_view OutcomeName(const AnswerBatch& answers, std::size_t i);

// The meaning of an answer without azimuth, by a table of winds and by a table of one sea.
inline constexpr std::string_view kWorseOfTheWind =
    "each value is the larger of those along and across the wind";
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

}  // namespace albtpu::annotate
