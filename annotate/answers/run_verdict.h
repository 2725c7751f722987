// Decides whether a run over files succeeded: a run without answers fails, although its outputs are complete.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "absl/status/status.h"
#include "annotate/answers/answer_tally.h"
#include "annotate/answers/likely_cause.h"

namespace albtpu::annotate {

class RunVerdict {
 public:
  // `record` is what the files contain, for the user, in the singular: "pulse", "chosen point".
  RunVerdict(CauseContext context, std::string record)
      : context_(std::move(context)), record_(std::move(record)) {}

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
