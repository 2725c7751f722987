// The answer to a command that lacks much of what it needs: all of it at once, beside what its file says, what would be
// assumed, and a line that works.
#pragma once

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "annotate/run/file_jobs.h"
#include "config/survey_draft.h"
#include "programs/command_line/cli_fwd.h"
#include "programs/query/las_options.h"

namespace albtpu::programs {

struct FirstContact {
  std::string command;                              // "las"
  std::vector<std::string> found = {};              // Lines about the file.
  std::vector<config::OpenDecision> open = {};      // What must be decided.
  std::vector<config::OpenDecision> of_total = {};  // What a total needs as well, where no sensor is named.
  std::vector<std::string> assumed = {};            // A line each.
  std::vector<std::string> example = {};  // Arguments of albtpu-query; empty: flags alone cannot close it all.
  std::vector<std::string> remedy = {};   // Arguments of albtpu-query that begin a survey file; empty: none do.
};

// Prints it to standard error; the UsageError is the end of it.
absl::Status Refuse(const FirstContact& contact);

// "albtpu-query las 'my line.las' ...", as a shell reads it.
std::string CommandLine(const std::vector<std::string>& arguments);

// The arguments that `command` was given, as its flags and words.
std::vector<std::string> GivenArguments(const CLI::App& command);

// IN_tpu.las, in the current folder, for IN.las: the name of an output in examples. `extension` may be empty.
std::string ExampleOutput(const std::string& input, const std::string& extension = "");

// Adds the output to what is open and to the example, where neither OUT nor a folder is given.
void AddMissingOutput(const annotate::FileOptions& files, const std::string& extension, FirstContact& contact);

// What `las` with these options leaves open; found, assumed and example by its first file. Requires that something is.
// Fails if this file cannot be read.
absl::StatusOr<FirstContact> ContactOf(const LasOptions& options, const config::SurveySettings& settings,
                                       std::vector<config::OpenDecision> open, const std::vector<std::string>& given);

}  // namespace albtpu::programs
