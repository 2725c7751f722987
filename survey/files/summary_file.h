// The summary beside each output, OUT.json: what was read, asked and answered. From it a later run tells
// whether the output is whole and what it would write itself.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "service/client/uncertainty_source.h"
#include "survey/files/file_jobs.h"
#include "survey/files/output_file.h"

namespace albtpu::client {

// OUT.las.json
std::filesystem::path SummaryPath(const std::filesystem::path& output);

// What decides, beside the input, what is written.
struct Making {
  std::string command;                // "las"
  nlohmann::ordered_json parameters;  // The flags, with their defaults.
  TableSummary table;
};

// What has been read and answered.
struct Findings {
  std::uint64_t input_bytes = 0;
  nlohmann::ordered_json input;    // More about it: points, classes.
  nlohmann::ordered_json answers;  // UncertaintySummary::Json().
};

// The text of a summary. No time, host or path: equal runs give equal bytes.
std::string SummaryText(const Making& making, const Job& job, const Findings& findings,
                        std::uint64_t output_bytes);

// OK when the output of `job` is there, has the size that its summary tells, was made in this way of an input
// of this name and size, and the input was not changed since. Otherwise what is different.
absl::Status CheckMade(const Making& making, const Job& job);

// AlreadyExists when something is to be kept that stands where the summary would go.
absl::Status CheckSummaryCanBeWritten(const Job& job, Existing existing);

// Gives output and summary their names, both or none: a summary is never beside an output that it does not
// describe. `existing` is for both.
absl::Status CommitWithSummary(OutputFile output, const Job& job, const std::string& summary,
                               Existing existing);

}  // namespace albtpu::client
