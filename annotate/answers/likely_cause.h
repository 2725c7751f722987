// Finds the mistake in the inputs of a run that explains why most pulses got no number.
#pragma once

#include <optional>
#include <string>

#include "annotate/answers/answer_tally.h"
#include "annotate/answers/batch.h"

namespace albtpu::annotate {

// The inputs from which the coordinates were computed.
struct CauseContext {
  TableAxes axes;                     // Of the table.
  std::optional<double> water_level;  // m; where one --water-level gave the depths of all points.
  bool water_level_by_time = false;   // A file gave the levels.
  // From altitude, or slant range, and divergence; none where it is not known.
  std::optional<bool> footprint_from_beam;
};

// For a message "PROBLEM (WHY); SUGGESTION".
struct LikelyCause {
  std::string why;         // "footprint 60 m is above 5 m, the last node of the table"
  std::string suggestion;  // "is the footprint in cm? give it in m"
};

// About the most frequent outcome without a number; none if there is none. A mistake is named only if its correction
// brings the median of the coordinate into the table.
std::optional<LikelyCause> FindLikelyCause(const AnswerTally& tally, const CauseContext& context);

}  // namespace albtpu::annotate
