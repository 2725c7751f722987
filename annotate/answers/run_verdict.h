// Whether a run over files succeeded, judged by its outcomes, and the mistake in its inputs that explains why pulses
// got no number.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "absl/status/status.h"
#include "annotate/answers/answer_counts.h"
#include "annotate/answers/batch.h"

namespace albtpu::annotate {

// Finds the mistake in the inputs of a run that explains why most pulses got no number.

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

// Decides whether a run over files succeeded: a run without answers fails, although its outputs are complete.
class RunVerdict {
 public:
  // `record` is what the files contain, for the user, in the singular: "pulse", "chosen point".
  RunVerdict(CauseContext context, std::string record) : context_(std::move(context)), record_(std::move(record)) {}

  // Counts a file that was written, or was complete already. Returns a message that names the file and the likely cause
  // if fewer than half of its pulses got a number, otherwise an empty text.
  std::string Add(std::string_view file, const AnswerTally& answers);

  // Of all files: fails if fewer than half of the pulses got a number, or if all of them are deeper than 20 m and would
  // not be with the other sign of --water-level. Names the file if there is only one.
  absl::Status status() const;

  // A message if no pulse that got a number is shallower than 20 m, otherwise an empty text. A lidar sees the shallow
  // water first: a survey of deep water alone is rarer than a wrong water level.
  std::string DeepNote() const;

 private:
  // m; of a run in which all depths are beyond 20 m, where a wrong sign of the water level explains it.
  std::optional<double> MinDepthWithOtherSign() const;
  std::string Problem(const AnswerTally& tally) const;

  CauseContext context_;
  std::string record_;
  AnswerTally all_;
  std::size_t files_ = 0;
  std::string last_file_;
};

}  // namespace albtpu::annotate
