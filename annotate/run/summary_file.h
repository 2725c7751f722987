// The summary beside each output, OUT.json: what was read, the parameters of the run and a summary of the answers. A
// later run reads it to decide whether the output is complete and the same as it would write itself.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "annotate/answers/answer_tally.h"
#include "annotate/answers/json_box.h"
#include "annotate/run/file_jobs.h"
#include "formats/files/output_file.h"
#include "service/client/uncertainty_source.h"

namespace albtpu::annotate {

// OUT.las.json
std::filesystem::path SummaryPath(const std::filesystem::path& output);

// Everything that determines the output, apart from the input.
struct OutputSettings {
  std::string command;  // "las"
  JsonBox parameters;   // The flags, including defaults.
  client::TableSummary table;
  std::vector<std::filesystem::path> files = {};  // Read beside the input, such as trajectories.
};

// The results of a run over one file.
struct Findings {
  std::uint64_t input_bytes = 0;
  JsonBox input;                       // Further properties: points, classes.
  JsonBox output = JsonBox::Object();  // Further properties: format.
  JsonBox answers;                     // UncertaintySummary::Json().
  AnswerTally tally = {};              // The same, for the verdict.
};

// The text of a summary. It states no time, host or path, so that equal runs give equal bytes.
std::string SummaryText(const OutputSettings& settings, const Job& job, const Findings& findings,
                        std::uint64_t output_bytes);

// OK when the output of `job` exists, has the size that its summary states, was made with these settings from an input
// of this name and size, and neither the input nor a file of the settings has been modified since. Otherwise the error
// says what differs.
absl::Status CheckComplete(const OutputSettings& settings, const Job& job);

// A summary; an empty object if there is no readable one. Values that are nested more deeply than in any summary of
// ours are dropped.
nlohmann::ordered_json ReadSummary(const std::filesystem::path& path);

// The answers that the summary of the output of `job` states; null if there are none.
nlohmann::ordered_json ReadAnswers(const Job& job);

// AlreadyExists when a file that is to be kept has the name of the output or of its summary.
absl::Status CheckSummaryCanBeWritten(const Job& job, Existing existing);

// Gives the output and the summary their names, both or neither: a summary never lies beside an output that it does
// not describe. `existing` applies to both.
absl::Status CommitWithSummary(OutputFile output, const Job& job, const std::string& summary,
                               Existing existing);

}  // namespace albtpu::annotate
