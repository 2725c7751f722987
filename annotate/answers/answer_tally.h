// The outcomes of a file or of a whole run. Outputs of an earlier run count, too, by their summaries.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace albtpu::annotate {

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

}  // namespace albtpu::annotate
