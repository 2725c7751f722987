// How many pulses had each outcome.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "survey/answers/batch.h"

namespace albtpu::client {

// "INTERPOLATED", "OUT_OF_DOMAIN:depth" or "INVALID", as CSV files and messages state it. The arguments are the
// numbers of AnswerColumns.
std::string_view OutcomeName(std::uint8_t outcome, std::uint8_t axis);

class OutcomeCounts {
 public:
  // `azimuth_absent` means that none of the pulses had an azimuth.
  void Add(const AnswerBatch& answers, bool azimuth_absent);
  void Merge(const OutcomeCounts& other);

  std::uint64_t total() const;
  std::uint64_t interpolated() const { return ByOutcome(0); }

  // "56382 pulses: 56000 interpolated, 382 OUT_OF_DOMAIN:depth", and the number without azimuth, if any.
  std::string Text() const;

  // {"INTERPOLATED": 56000, "OUT_OF_DOMAIN:depth": 382}; other outcomes appear only if they occurred.
  nlohmann::ordered_json Json() const;
  std::uint64_t without_azimuth() const { return without_azimuth_; }

 private:
  static constexpr std::size_t kOutcomes = 3;
  static constexpr std::size_t kAxesAndNone = kAxisCount + 1;

  std::uint64_t ByOutcome(std::size_t outcome) const;

  // By outcome and axis, numbered as in AnswerColumns, but with outcomes counted from 0.
  std::array<std::array<std::uint64_t, kAxesAndNone>, kOutcomes> counts_ = {};
  std::uint64_t without_azimuth_ = 0;
};

}  // namespace albtpu::client
